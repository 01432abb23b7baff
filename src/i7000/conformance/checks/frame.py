"""The frames of both protocols: their ends, checksums and addresses, and what is not a frame (manual 2, 3).

Laws: what is not a frame for the module is never answered; the sentinel after it is.
"""

from collections.abc import Callable, Iterable

from i7000 import dcon, modbus
from i7000.conformance.checks.steps import Steps
from i7000.conformance.oracle import difference
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Note, Skipped, SkipReason
from i7000.host.procedures import Procedure
from i7000.modbus.request import LAST_ADDRESS

__all__ = ["STEPS"]

_PAUSE = 0.06
"""The pause in seconds between frames that are all for nobody."""
_SETTLED = 0.15
"""How long an answer to garbage is waited for, in seconds."""
_LONG = 300
"""More characters than any frame has."""


def _unheard(frames: Callable[[Subject], Iterable[bytes]]) -> Steps:
    """Return the steps that send frames which the module must not answer, one after the other."""

    def steps(module: Subject) -> Procedure[None]:
        yield from module.silent(*((_PAUSE, frame) for frame in frames(module)))

    return steps


def _either(frame: Callable[[Subject], bytes], what: str) -> Steps:
    """Return the steps that send a frame which the module may answer as the sentinel, and say what it does."""

    def steps(module: Subject) -> Procedure[None]:
        wire = frame(module)
        answer = module.hear_sentinel().wire
        heard = yield from module.expect_one_of(wire, (None, answer))
        raise Note(f"{what} {'is not' if heard is None else 'is'} answered", sent=wire, received=heard or b"")

    return steps


# --- DCON -------------------------------------------------------------------------------------------------------------


def _carriage_return(module: Subject) -> Procedure[None]:
    wire = module.wire(module.sentinel)
    body, end = wire[:-1], wire[-1:]
    heard = (yield from module.send(body, seconds=0.3)).wire
    if heard:
        raise module.wrong("answered without a carriage return", body, heard, "silence")
    answer = module.hear_sentinel()
    heard = (yield from module.send(end)).wire
    if difference(answer, heard):
        raise module.wrong("the carriage return did not end the command", body + end, heard, "the answer to it")


def _summed(change: Callable[[bytes], bytes]) -> Steps:
    """Return the steps that send a command with something else in place of its checksum."""

    def steps(module: Subject) -> Procedure[None]:
        if not module.profile.checksum:
            raise Skipped(SkipReason.NOT_APPLICABLE, "the module uses no checksum")
        wire = module.wire(module.sentinel)
        body, digits = wire[:-3], wire[-3:-1]
        yield from module.silent(body + change(digits) + b"\r")

    return steps


def _other_sum(digits: bytes) -> bytes:
    return b"%02X" % ((int(digits, 16) + 1) & 0xFF)


def _high_digit(digits: bytes) -> bytes:
    return b"%02X" % (int(digits, 16) ^ 0x80)


def _lower_sum(module: Subject) -> Procedure[None]:
    if not module.profile.checksum:
        raise Skipped(SkipReason.NOT_APPLICABLE, "the module uses no checksum")
    address = module.address
    for query in (dcon.ReadModuleName(address), dcon.ReadConfiguration(address), dcon.ReadFirmwareVersion(address)):
        wire = module.wire(query)
        lower = wire[:-3] + wire[-3:].lower()
        if lower != wire:
            answer = module.hear(wire).wire
            heard = yield from module.expect_one_of(lower, (None, answer))
            words = "is silent" if heard is None else "answers"
            raise Note(f"the module {words} if the checksum is in lower case", sent=lower, received=heard or b"")
    raise Skipped(SkipReason.NOT_APPLICABLE, "at this address, no checksum of a plain read has a letter")


def _others(address: int, last: int) -> list[int]:
    """Return addresses that a module could confuse with its own."""
    near = (address ^ 0x01, address ^ 0x10, address ^ 0x80, (address & 0x0F) << 4 | address >> 4, 0x00, 0xFF)
    return sorted({other for other in near if other != address and other <= last})


def _of_text(*texts: bytes) -> Steps:
    """Return the steps for texts in which {} stands for the address; each gets its checksum."""

    def frames(module: Subject) -> Iterable[bytes]:
        address = b"%02X" % module.address
        return (module.seal(text.replace(b"{}", address)) for text in texts)

    return _unheard(frames)


def _foreign_dcon(module: Subject) -> Iterable[bytes]:
    return (module.wire(dcon.ReadModuleName(other)) for other in _others(module.address, 0xFF))


def _plain(text: bytes) -> Callable[[Subject], bytes]:
    def frame(module: Subject) -> bytes:
        wire = module.wire(module.sentinel)
        return text.replace(b"{}", wire.removesuffix(b"\r")) + b"\r"

    return frame


def _lower_case(module: Subject) -> bytes:
    return module.seal(module.wire(dcon.ReadModuleName(module.address))[:4].lower())


def _too_long(module: Subject) -> Iterable[bytes]:
    return (module.seal(b"$%02XM" % module.address + b"M" * _LONG),)


# --- Modbus RTU -------------------------------------------------------------------------------------------------------


def _swapped(module: Subject) -> Iterable[bytes]:
    wire = module.wire(module.sentinel)
    return (wire[:-2] + wire[-1:] + wire[-2:-1],)


def _cut(module: Subject) -> Iterable[bytes]:
    wire = module.wire(modbus.ReadInputRegisters(module.address, 0, 1))
    return (wire[:size] for size in range(1, len(wire)))


def _foreign_units(module: Subject) -> Iterable[bytes]:
    return (
        modbus.seal(bytes((other,)) + module.wire(module.sentinel)[1:-2])
        for other in _others(module.address, LAST_ADDRESS)
        if other
    )


def _answers_of_others(module: Subject) -> Iterable[bytes]:
    other = 2 if module.address == 1 else 1
    return (modbus.seal(bytes((other, 4, 2, 0x12, 0x34))), modbus.seal(bytes((other, 0x84, 2))))


def _noise_before(module: Subject) -> bytes:
    return b"\xff\x00" + module.wire(module.sentinel)


def _long_frames(module: Subject) -> Iterable[bytes]:
    return (modbus.seal(bytes((module.address, 4)) + bytes(_LONG)),)


# --- what comes after it ----------------------------------------------------------------------------------------------

Garbage = Callable[[Subject], Iterable[tuple[str, bytes]]]
"""Returns bytes that the module should ignore, each with its name."""


def _recovers(garbage: Garbage) -> Steps:
    """Return the steps that send garbage, and a request after each: it is answered, whatever became of the garbage."""

    def steps(module: Subject) -> Procedure[None]:
        request = module.wire(module.sentinel)
        for name, wire in garbage(module):
            yield from module.send(wire, seconds=_SETTLED)
            answer = module.hear_sentinel()
            heard = (yield from module.send((_PAUSE, request))).wire
            if difference(answer, heard):
                text = f"a request after {name} is {'answered otherwise' if heard else 'not answered'}"
                raise module.wrong(text, wire + request, heard, "the answer to the request", answer.wire or b"")

    return steps


def _garbage_of_dcon(module: Subject) -> Iterable[tuple[str, bytes]]:
    address = b"%02X" % module.address
    if module.profile.checksum:
        wire = module.wire(module.sentinel)
        yield "a wrong checksum", wire[:-3] + _other_sum(wire[-3:-1]) + b"\r"
    yield "half a command", b"$" + address[:1] + b"\r"
    yield "a command without its letter", module.seal(b"$" + address)
    yield "a command to another address", next(iter(_foreign_dcon(module)))
    yield "an answer of another module", module.seal(b"!%02X" % _others(module.address, 0xFF)[0])
    yield "long text", next(iter(_too_long(module)))
    yield "a carriage return", b"\r"


def _garbage_of_modbus(module: Subject) -> Iterable[tuple[str, bytes]]:
    wire = module.wire(module.sentinel)
    yield "a wrong CRC", wire[:-1] + bytes((wire[-1] ^ 0x01,))
    yield "a truncated request", wire[: len(wire) // 2]
    yield "a single byte", wire[:1]
    yield "a request to another address", next(iter(_foreign_units(module)))
    yield "an answer of another module", next(iter(_answers_of_others(module)))
    yield "a long request", next(iter(_long_frames(module)))
    yield "text", b"U" * _LONG + b"\r"


STEPS: dict[str, Steps] = {
    "frame/recovers/dcon": _recovers(_garbage_of_dcon),
    "frame/recovers/rtu": _recovers(_garbage_of_modbus),
    "frame/dcon/end": _carriage_return,
    "frame/dcon/checksum-wrong": _summed(_other_sum),
    "frame/dcon/checksum-wrong-high-digit": _summed(_high_digit),
    "frame/dcon/checksum-absent": _summed(lambda _: b""),
    "frame/dcon/checksum-lower-case": _lower_sum,
    "frame/dcon/address": _unheard(_foreign_dcon),
    "frame/dcon/leading-character": _of_text(b"&{}M", b"*{}M", b"{}M", b"!{}M"),
    "frame/dcon/truncated": _of_text(b"$", b"$0", b"M"),
    "frame/dcon/answers-of-others": _of_text(b"!{}7018", b"!{}", b">+025.12", b"?{}"),
    "frame/dcon/long": _unheard(_too_long),
    "frame/dcon/lower-case": _either(_lower_case, "a command in lower case"),
    "frame/dcon/noise-before": _either(_plain(b"\xff\x00{}"), "a command after noise"),
    "frame/dcon/doubled": _either(_plain(b"$0{}"), "a command after an unfinished one"),
    "frame/rtu/crc-swapped": _unheard(_swapped),
    "frame/rtu/truncated": _unheard(_cut),
    "frame/rtu/address": _unheard(_foreign_units),
    "frame/rtu/answers-of-others": _unheard(_answers_of_others),
    "frame/rtu/long": _unheard(_long_frames),
    "frame/rtu/noise-before": _either(_noise_before, "a request after noise"),
}

"""Changes on a line that loses, flips, repeats and delays bytes: they end, and their report is true."""

from typing import Any

from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, dcon, modbus
from i7000.device import Eeprom, factory
from i7000.host.procedures.change import restore
from i7000.host.procedures.restoring import Restoration, Status
from i7000.host.procedures.settings import settings_of
from i7000.host.procedures.snapshot import Snapshot, snapshot
from i7000.strategies.settings import plain_values
from tests.host.procedures.eeproms import two_modules
from tests.host.procedures.runner_settings import Bench, Spoil

WANTED = (Status.DONE, Status.ALREADY, Status.PENDING)
UNCHANGED = (Status.REFUSED, Status.NEEDS_INIT, Status.UNREAD, Status.SKIPPED)
GRACE = 0.15
"""How late an answer may be after its time, in seconds: within the pause that a host keeps."""


def faults(data: st.DataObject, most: int) -> Spoil:
    """Make a line with faults that a checksum sees, up to `most` of them; then the line is quiet, or dead.

    A request is not repeated: its second answer could come after a pause, which a host cannot tell from the answer to
    its next request.
    """
    left = data.draw(st.integers(0, most))
    dead = data.draw(st.booleans())
    chance = data.draw(st.randoms(use_true_random=False))

    def spoil(wire: bytes, to_module: bool) -> list[tuple[float, bytes]]:  # noqa: FBT001
        nonlocal left
        if chance.random() < 0.5 or not (left or dead):
            return [(0.0, wire)]
        if not left:
            return []
        left -= 1
        at = chance.randrange(len(wire))
        flipped = wire[:at] + bytes((wire[at] ^ 1 << chance.randrange(8),)) + wire[at + 1 :]
        pieces: tuple[list[tuple[float, bytes]], ...] = (
            [],
            [(0.0, seen(wire, flipped))],
            [(0.0, seen(wire, wire[:at] + wire[at + 1 :]))],
            [(0.0, seen(wire, chance.randbytes(3) + wire))],
            [(0.0, wire)] if to_module else [(0.0, wire), (0.001, wire)],
            [(chance.random() * GRACE, wire)],
        )
        return chance.choice(pieces)

    return spoil


def seen(wire: bytes, damaged: bytes) -> bytes:
    """What is left of a frame is damaged for every checksum, or the frame itself; or nothing is."""
    if wire.endswith(b"\r"):
        frames: Any = dcon.split(damaged, checksum=True)[0]
    else:
        frames = (*modbus.flush(damaged, modbus.Side.BOTH),)
    return damaged if {it for it in frames if isinstance(it, bytes)} <= {wire} else b""


def truth(bench: Bench) -> dict[str, Any]:
    """What the module really holds, read where it really is over a good line."""
    module = bench.modules.modules[0]
    other = Bench(bench.modules, line=module.ram.line_settings, now=bench.now + 10)
    taken = other.run(snapshot(module.ram.address, module.profile, module.ram.protocol))
    assert taken.unread == ()
    return dict(taken.settings)


def check(made: Restoration, before: dict[str, Any], bench: Bench) -> None:
    after = truth(bench)
    for it in made.results:
        if it.name not in after:  # a channel of the other connecting mode
            continue
        held = after[it.name]
        if it.status in WANTED:
            assert it.wanted == held, it
        elif it.status in UNCHANGED:
            assert before.get(it.name, held) == held, it
        elif it.status is Status.NOT_VERIFIED:
            assert it.after == held, it
        else:
            assert held in (it.before, it.wanted), it
    for name in set(before) & set(after) - {it.name for it in made.results}:
        assert before[name] == after[name]


def with_checksum(eeprom: Eeprom) -> Eeprom:
    report = evolve(eeprom.report_settings, checksum=True)
    return evolve(eeprom, report_settings=report, host_watchdog_enabled=False, single_ended=False)


@given(two_modules(), st.data())
def test_what_is_reported_of_plain_settings_is_true(both: tuple[Eeprom, Eeprom], data: st.DataObject) -> None:
    one, other = map(with_checksum, both)
    bench = Bench.of(one)
    before = truth(bench)
    wanted = Snapshot(one.model, protocol=one.protocol, settings=truth(Bench.of(other)))
    bench.spoil = faults(data, 12)
    profile = bench.modules.modules[0].profile

    made = bench.run(restore(one.address, profile, wanted, protocol=one.protocol))

    assert {it.name for it in made.results} == set(dict(wanted.settings))
    check(made, before, bench)


LOSING = ("address", "baud_rate", "character_format", "checksum", "protocol")


@given(st.data(), st.sampled_from((Model.M_7019R, Model.I_7019R, Model.M_7017mC_16, Model.I_7018, Model.M_7018)))
def test_what_is_reported_of_settings_that_lose_the_module_is_true(data: st.DataObject, model: Model) -> None:
    protocol = data.draw(st.sampled_from(sorted(model.protocols)))
    one = with_checksum(evolve(factory(model), protocol=protocol))
    bench = Bench.of(one)
    profile = bench.modules.modules[0].profile
    settings = {it.name: it.values for it in settings_of(profile, protocol) if it.name in LOSING}
    wanted = Snapshot(
        model, protocol=protocol, settings={name: data.draw(plain_values(it)) for name, it in settings.items()}
    )
    before = truth(bench)
    bench.spoil = faults(data, 8)

    made = bench.run(restore(1, profile, wanted, [name for name, _ in wanted.settings], protocol=protocol))

    check(made, before, bench)
    if not any(it.status is Status.IN_DOUBT for it in made.results):
        module = bench.modules.modules[0]
        assert (made.address, made.profile.checksum) == (module.ram.address, module.ram.checksum)


@given(two_modules(), st.data())
def test_a_snapshot_has_only_what_the_module_holds(both: tuple[Eeprom, Eeprom], data: st.DataObject) -> None:
    one = with_checksum(both[0])
    bench = Bench.of(one)
    held = truth(bench)
    bench.spoil = faults(data, 12)

    taken = bench.run(snapshot(one.address, bench.modules.modules[0].profile, one.protocol))

    assert dict(taken.settings).items() <= held.items()
    assert set(held) == (set(dict(taken.settings)) | set(dict(taken.unread))) - ({"firmware", "name"} - set(held))

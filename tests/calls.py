"""One sound call of everything public: what the tests of arguments and of growth change one argument of.

Laws: `CALLS` and `LEFT_OUT` name every public function, method and constructor between them, and none twice.
"""

import inspect
from collections.abc import Callable, Iterator
from enum import Enum
from functools import partial
from types import FunctionType
from typing import Any

from attrs import fields, frozen

import i7000
from i7000 import (
    BaudRate,
    DataFormat,
    Firmware,
    Model,
    Profile,
    Reading,
    TypeCode,
    Unit,
    dcon,
    device,
    dissect,
    host,
    modbus,
)
from i7000.host import procedures
from i7000.message import Message
from i7000.models import CONFIGURABLE
from tests.spec.lint import vectors
from tests.vectors import MESSAGES, MODBUS_MESSAGES, message_of

MODULES = {
    "i7000": i7000, "dcon": dcon, "modbus": modbus, "host": host, "procedures": procedures, "device": device,
    "dissect": dissect,
}  # fmt: skip

BASES = (
    dcon.Broadcast, dcon.Command, dcon.Message, dcon.Response, modbus.Message, modbus.Request, modbus.Response,
    modbus.SettingResult, host.Query, host.Response,
)  # fmt: skip
"""The base classes of messages, which cannot be constructed."""

# --- the public surface -----------------------------------------------------------------------------------------------


def _members(name: str, kind: type) -> Iterator[str]:
    """The public functions of a class, its own and inherited ones of ours."""
    if not issubclass(kind, Enum) and kind not in BASES:
        yield name
    for attribute in sorted({attribute for base in kind.__mro__ for attribute in vars(base)}):
        static = inspect.getattr_static(kind, attribute)
        function = getattr(static, "__func__", static)
        ours = isinstance(function, FunctionType) and (function.__module__ or "").startswith("i7000")
        if ours and not attribute.startswith("_"):
            yield f"{name}.{attribute}"


def surface() -> Iterator[str]:
    """Every public function, method and constructor, by the module that names it."""
    for module, namespace in MODULES.items():
        for name in namespace.__all__:
            value = getattr(namespace, name)
            if isinstance(value, FunctionType):
                yield f"{module}.{name}"
            elif isinstance(value, type):
                yield from _members(f"{module}.{name}", value)


def kind_of(name: str) -> Any:
    """The class or function that a public name begins with."""
    module, kind, *_ = name.split(".")
    return getattr(MODULES[module], kind)


# --- sound calls ------------------------------------------------------------------------------------------------------


@frozen
class Call:
    """A call that does what it should."""

    name: str
    function: Callable[..., Any]
    args: tuple[Any, ...]
    kwargs: dict[str, Any]

    @property
    def constructs(self) -> bool:
        """Whether it makes a value of its arguments, as named constructors do too."""
        return isinstance(self.function, type) or self.name.endswith((".of", ".from_byte", ".command"))

    def arguments(self) -> Iterator[tuple[Any, Callable[[Any], Any]]]:
        """Each argument, and the call as a function of it."""
        for at, argument in enumerate(self.args):
            yield argument, partial(self._with_positional, at)
        for name, argument in self.kwargs.items():
            yield argument, partial(self._with_keyword, name)

    def _with_positional(self, at: int, value: Any) -> Any:
        return self.function(*self.args[:at], value, *self.args[at + 1 :], **self.kwargs)

    def _with_keyword(self, name: str, value: Any) -> Any:
        return self.function(*self.args, **(self.kwargs | {name: value}))


def call(name: str, /, *args: Any, on: Any = None, **kwargs: Any) -> Call:
    """A call by name: of a method, on an instance."""
    module, *path = name.split(".")
    function: Any = MODULES[module] if on is None else on
    for part in path if on is None else path[-1:]:
        function = getattr(function, part)
    return Call(name, function, args, kwargs)


def _messages() -> Iterator[Call]:
    """The constructor of every message, with the fields that a vector has."""
    for module, folder, kinds in (("dcon", "dcon", MESSAGES), ("modbus", "modbus", MODBUS_MESSAGES)):
        found: dict[type, Any] = {dcon.Acknowledged: dcon.Acknowledged(0x01)}
        for _, vector in vectors(folder):
            for record in (vector.get("command") or vector.get("request"), vector["response"]):
                if record is not None:
                    message = message_of(record, kinds)
                    found.setdefault(type(message), message)
        for name in MODULES[module].__all__:
            kind = getattr(MODULES[module], name)
            if kind in found:
                values = {it.name: getattr(found[kind], it.name) for it in fields(kind)}
                keywords = {it.name: values.pop(it.name) for it in fields(kind) if it.kw_only}
                yield call(f"{module}.{name}", *values.values(), **keywords)
                yield call(f"{module}.{name}.describe", None, on=found[kind])


_I7018 = Profile(Model.I_7018)
_M7019 = Profile(Model.M_7019R)
_READ = dcon.ReadAnalogInput(0x01, 0)
_REPORT = dcon.AnalogInputs(("+1.0000",) * 8)
_WORDS = modbus.ReadInputRegisters(0x01, 0, 2)
_WORDS_WIRE = modbus.encode(_WORDS)
_ANSWER = modbus.encode(modbus.InputRegisters(0x01, (1, 2)))
_READINGS = (Reading(1.0, Unit.VOLT),) * 8
_REGISTERS = modbus.RegisterMap(_M7019)
_PLAN = _REGISTERS.plan(0x01, ["response_delay"])
_MODULE = device.power_on(device.factory(Model.I_7018), now=1.0)
_MODULES = device.Bus((_MODULE,))
_SIGNALS = device.Signals()
_UART = device.Uart()
_BUS = host.Bus[Any]()
_SCANNED = ((i7000.LineSettings(),), (0x01,), (i7000.Protocol.DCON,), (False,))
_OPEN = host.send(_BUS, _READ, _I7018, 1.0)

_EEPROM = device.factory(Model.M_7019R)
_SNAPSHOT = procedures.Snapshot(Model.I_7018, settings={"filter": "reject_50_hz"}, unread={"address": "no answer"})
_RESTORED = procedures.Restored("filter", procedures.Status.ALREADY, "reject_50_hz")
_FACT = dissect.Fact("types", (TypeCode.K,))
_HEARD_OF = dissect.Module()
_KNOWLEDGE = dissect.Knowledge(_HEARD_OF, {0x01: _HEARD_OF})
_LINE = dissect.Line(_KNOWLEDGE, i7000.Protocol.DCON)


def _fields_of(value: Any) -> dict[str, Any]:
    return {it.name: getattr(value, it.name) for it in fields(type(value)) if it.init}


CALLS = (
    call("i7000.BaudRate.of", 6, on=BaudRate),
    call("i7000.DataFormat.of", 1, on=DataFormat),
    call("i7000.TypeCode.name_of", 15, on=TypeCode),
    call("i7000.TypeCode.of", 15, on=TypeCode),
    call("i7000.Firmware", "B3.7"),
    call("i7000.Firmware.from_bytes", bytes((0x0B, 3, 7)), on=Firmware),
    call("i7000.LineSettings", *_fields_of(i7000.LineSettings()).values()),
    call("i7000.LineSettings.from_byte", 6),
    call("i7000.Model.find", "I-7018", on=Model),
    call("i7000.Model.series_of", bytes.fromhex("00701900"), on=Model),
    call("i7000.Profile", Model.M_7017, **{k: v for k, v in _fields_of(Profile(Model.M_7017)).items() if k != "model"}),
    call("i7000.Profile.check_channel", 1, "2.4", on=_I7018),
    call("i7000.Profile.check_cjc_offset", 1, "2.18", on=_I7018),
    call("i7000.Profile.check_line", i7000.LineSettings(), "1.11", on=_I7018),
    call("i7000.Profile.check_mask", 1, "2.13", on=_I7018),
    call("i7000.Profile.check_name", "7018", "2.33", on=_I7018),
    call("i7000.Profile.check_report", i7000.ReportSettings(), "1.11", on=_I7018),
    call("i7000.Profile.check_type_code", 5, "2.15", field="type_code", on=_I7018),
    call("i7000.Profile.has", CONFIGURABLE, on=_I7018),
    call("i7000.Profile.runs", Firmware("B3.7"), on=_I7018),
    call("i7000.Profile.supports", 5, on=_I7018),
    call("i7000.Profile.supported_types", on=_I7018),
    call("i7000.ReportSettings", 1, checksum=True, fast_mode=False, filter=i7000.Filter.REJECT_50_HZ, reserved=0),
    call("i7000.ReportSettings.from_byte", 6),
    call("i7000.series", "7017Z"),
    *_messages(),
    call(
        "dcon.Configuration.command", new_address=2, type_code=5,
        on=dcon.Configuration(1, 5, i7000.LineSettings(), i7000.ReportSettings()),
    ),
    call("dcon.channels_of", 0x3A),
    call("dcon.checksum", b"$012"),
    call("dcon.decode_command", b"#010\r", _I7018),
    call("dcon.decode_response", b">+1.0000\r", _READ, _I7018),
    call("dcon.encode", _READ, _I7018, force=False),
    call("dcon.field", _READINGS[0], 0, _I7018),
    call("dcon.fields", _READINGS, _I7018),
    call("dcon.is_answered", _READ),
    call("dcon.longest_response", _READ, _I7018),
    call("dcon.mask_of", (1, 2)),
    call("dcon.pause_after", _READ, _I7018),
    call("dcon.reading", dcon.AnalogInput("+1.0000"), 0, _I7018, lenient=False),
    call("dcon.readings", _REPORT, _I7018, lenient=False),
    call("dcon.seal", b"$012", checksum=True),
    call("dcon.split", b"$012\r$0", checksum=False),
    call("dcon.unseal", b"$012\r", checksum=False, leads=b"$"),
    call("modbus.CjcOffset.celsius", modbus.ReadCjcOffset(1, 0), on=modbus.CjcOffset(1, 5)),
    call("modbus.Plan.decode", (modbus.HoldingRegisters(0x01, (5,)),), on=_PLAN),
    call("modbus.RegisterMap", _M7019),
    call("modbus.RegisterMap.find", "response_delay", modbus.Area.HOLDING_REGISTER, on=_REGISTERS),
    call("modbus.RegisterMap.read", 1, "type_code", channels=range(2), on=_REGISTERS),
    call("modbus.RegisterMap.write", 1, "response_delay", 5, channels=None, big_endian=False, on=_REGISTERS),
    call("modbus.RegisterMap.decode", "response_delay", (5,), channels=None, big_endian=False, on=_REGISTERS),
    call("modbus.RegisterMap.plan", 1, ("response_delay", "filter"), big_endian=False, on=_REGISTERS),
    call("modbus.channels_of", 0x3A),
    call("modbus.crc16", b"\x01\x04"),
    call("modbus.decode_request", _WORDS_WIRE, _M7019),
    call("modbus.decode_response", _ANSWER, _WORDS, _M7019),
    call("modbus.drop_echo", _WORDS_WIRE + _ANSWER, _WORDS_WIRE),
    call("modbus.encode", _WORDS, _M7019, force=False),
    call("modbus.flush", _ANSWER, modbus.Side.RESPONSES, _M7019, request=_WORDS),
    call("modbus.is_answered", _WORDS),
    call("modbus.longest_response", _WORDS, _M7019),
    call("modbus.mask_of", (1, 2)),
    call("modbus.pause_after", _WORDS, _M7019),
    call("modbus.readings", (1, 2), _M7019, channel=0),
    call("modbus.seal", b"\x01\x04"),
    call("modbus.split", _ANSWER, modbus.Side.RESPONSES, _M7019, request=_WORDS),
    call("modbus.unseal", _ANSWER),
    call("modbus.words", _READINGS, _M7019, channel=0),
    call("host.Bus", *_fields_of(_OPEN).values()),
    call("host.Policy", **_fields_of(host.Policy())),
    call("host.next_deadline", _OPEN),
    call("host.receive", _OPEN, b">+1.0000\r", 1.1),
    call("host.send", _BUS, _READ, _I7018, 1.0),
    call("host.abandon", _OPEN, 1.1),
    call("procedures.Ask", _READ, _I7018, None),
    call("procedures.Tune", i7000.LineSettings()),
    call("procedures.Wait", 1.0),
    call("procedures.SendBytes", ((0.0, b"$01M\r"),), 0.5, 0.05, b"\r"),
    call("procedures.ask", _READ, _I7018, None),
    call("procedures.identify", 0x01, protocols=(i7000.Protocol.DCON,), checksum=False, policy=host.Policy()),
    call("procedures.places", *_SCANNED),
    call("procedures.read", 0x01, _I7018, protocol=i7000.Protocol.DCON, mask=0xFF, policy=host.Policy()),
    call("procedures.scan", *_SCANNED, policy=host.Policy()),
    call("procedures.scan_time", *_SCANNED, policy=host.Policy()),
    call("procedures.diff", _SNAPSHOT, procedures.Snapshot(Model.I_7018)),
    call("procedures.find_setting", "filter", _I7018, i7000.Protocol.DCON),
    call("procedures.hazard_of", "type_code.3"),
    call(
        "procedures.restore", 0x01, _I7018, _SNAPSHOT, ("filter",), protocol=i7000.Protocol.DCON,
        line=i7000.LineSettings(),
    ),
    call(
        "procedures.set_one", 0x01, _I7018, "filter", "reject_50_hz", protocol=i7000.Protocol.DCON,
        line=i7000.LineSettings(),
    ),
    call("procedures.settings_of", _I7018, i7000.Protocol.DCON),
    call("procedures.snapshot", 0x01, _I7018, i7000.Protocol.DCON),
    call("procedures.Restoration.of", "filter", on=procedures.Restoration((_RESTORED,), 0x01, _I7018)),
    call("procedures.Snapshot", **_fields_of(_SNAPSHOT)),
    call("procedures.Snapshot.from_json", _SNAPSHOT.to_json(), on=procedures.Snapshot),
    call("procedures.Snapshot.to_json", on=_SNAPSHOT),
    call("device.Bus", (_MODULE,), clock=1.0),
    call("device.Bus.step", b"#010\r", (_SIGNALS,), 1.0, on=_MODULES),
    call("device.Bus.hear", device.Ear(), b"#010\r", (_SIGNALS,), 1.0, on=_MODULES),
    call("device.Bus.silence", device.Ear(), (_SIGNALS,), 1.0, on=_MODULES),
    call("device.Ear", _UART, rests=(), dcon_reported=False),
    call("device.Ear.ends_with", b"#010\r", on=device.Ear()),
    call("device.Eeprom", **_fields_of(_EEPROM)),
    call("device.Eeprom.check_types", Profile(Model.M_7019R), on=_EEPROM),
    call("device.Ram", **_fields_of(_MODULE.ram)),
    call("device.Signal", 1.0, Unit.VOLT),
    call("device.Signals", (None,), cold_junction=25.0),
    call("device.Signals.of", Unit.VOLT, 1.0, 2.0, cold_junction=25.0),
    call("device.Signals.channel", 0, on=_SIGNALS),
    call("device.State", _MODULE.eeprom, _MODULE.ram, clock=1.0),
    call("device.State.switched", init_switch=True, on=_MODULE),
    call("device.Uart", 9600, parity="N", stop_bits=1, data_bits=8),
    call("device.Uart.of", i7000.LineSettings()),
    call("device.Uart.parity_bit", 0x55, on=_UART),
    call("device.Uart.sounds_like", _UART, on=_UART),
    call("device.advance", _MODULE, _SIGNALS, 1.0),
    call("device.factory", Model.M_7019R, Firmware("B3.7")),
    call("device.power_on", _EEPROM, init_switch=False, now=1.0),
    call("device.step", _MODULE, b"#010\r", _SIGNALS, 1.0),
    call("dissect.Fact", **_fields_of(_FACT)),
    call("dissect.Known", **_fields_of(dissect.Known())),
    call("dissect.Known.of", _I7018, on=dissect.Known),
    call("dissect.Knowledge", _HEARD_OF, {0x01: _HEARD_OF}),
    call("dissect.Knowledge.given", dissect.Known(), {0x01: dissect.Known()}, on=dissect.Knowledge),
    call("dissect.Knowledge.move", 0x01, 0x02, on=_KNOWLEDGE),
    call("dissect.Knowledge.of", 0x01, on=_KNOWLEDGE),
    call("dissect.Knowledge.put", 0x01, _HEARD_OF, on=_KNOWLEDGE),
    call("dissect.Line", **_fields_of(_LINE)),
    call("dissect.Module", dissect.Known(), {"types": _FACT}),
    call("dissect.Module.gives", "types", on=_HEARD_OF),
    call("dissect.Module.learn", _FACT, on=_HEARD_OF),
    call("dissect.Module.without", ("types",), on=_HEARD_OF),
    call("dissect.find", "TX: $012"),
    call("dissect.flush", _LINE, "packet 1"),
    call("dissect.hear", _LINE, b"$012", "packet 1"),
    call("dissect.hear_frame", _LINE, b"$012\r", i7000.Protocol.DCON, dissect.Place(1, "line 1")),
    call("dissect.meanings", b"!01050600\r", b"$012\r", dissect.Known()),
    call("dissect.pieces", ((1, "$012"),), i7000.Protocol.DCON),
)  # fmt: skip

# --- what is left out -------------------------------------------------------------------------------------------------

_HANDED_OUT = "a record that the package hands out: it holds what it is given, and nothing takes it back unchecked"
_BASE = "a base class, which nobody makes an instance of"
_BY_ENCODE = "called by `encode`, which has checked the profile"
_OF_THE_MODEL = "called by `step`, which has checked the time: the logger is the model's own"
_BY_NAME = "takes changes by the names of fields, which the model makes"

LEFT_OUT = {
    "i7000.Reading": "a named tuple, made for every channel of every poll; whoever takes one checks it",
    **dict.fromkeys(
        (
            "i7000.ArgumentError", "i7000.DecodeError", "i7000.EncodeError", "i7000.I7000Error",
            "i7000.InvalidValueError", "i7000.StateError", "i7000.Noise", "modbus.Plan", "modbus.Register",
            "modbus.LogRecord", "host.Answered", "host.Declined", "host.Late", "host.Rejected", "host.Sent",
            "host.TimedOut", "host.Transmit", "procedures.Result", "procedures.Tell",
            "procedures.BytesHeard", "procedures.PowerCycle",
            "procedures.Candidate", "procedures.ChannelFault", "procedures.Finding", "procedures.Identified",
            "procedures.Place", "procedures.Progress", "procedures.Report", "procedures.Scanned", "procedures.Unknown",
            "procedures.Change", "procedures.Restoration", "procedures.Restored", "procedures.Setting",
            "procedures.Writing", "device.Heard", "device.Record", "dissect.ChannelReading",
            "dissect.Field", "dissect.Fit", "dissect.Found", "dissect.Heard", "dissect.Item",
            "dissect.Meaning", "dissect.Piece", "dissect.Place",
        ),
        _HANDED_OUT,
    ),
    "host.Ended": _BASE,
    "procedures.confirmed": "takes a procedure, which can be run only once",
    **{name: _BASE for name in surface() if name.endswith(".describe") and kind_of(name) in BASES},
    "modbus.Register.describe": "describes what `RegisterMap.decode` gave",
    **dict.fromkeys(
        [name for name in surface() if name.endswith((".check", ".reserved_bits"))],
        _BY_ENCODE,
    ),
    **dict.fromkeys([name for name in surface() if f"{name}.".startswith("device.Log.")], _OF_THE_MODEL),
    **dict.fromkeys(("device.State.store", "device.State.keep"), _BY_NAME),
}  # fmt: skip
"""What no call is given for, and why."""


def is_message(name: str) -> bool:
    """Whether a name is that of a message class."""
    value = kind_of(name)
    return isinstance(value, type) and issubclass(value, Message)

"""The functions that are made from the statements of messages: their source can be read where they fail."""

import traceback
from typing import Any

import pytest

from i7000 import EncodeError, dcon, modbus
from i7000.dcon import parts
from i7000.message import frozen
from i7000.modbus import items


@pytest.mark.parametrize(
    ("kind", "value", "line"),
    [(dcon.SetChannelMask, 1 << 24, "refuse('mask', mask)"), (modbus.ReadTypeCode, 256, "refuse('channel', channel)")],
    ids=["dcon", "modbus"],
)
def test_a_traceback_shows_the_line_that_refused_a_value(kind: Any, value: int, line: str) -> None:
    with pytest.raises(EncodeError) as caught:
        kind(0x01, value)

    shown = traceback.format_exception(caught.value)
    assert any(line in entry and f"{kind.__module__}.{kind.__name__}>" in entry for entry in shown)


@frozen
class SetFirst(dcon.Command[dcon.Acknowledged]):
    syntax = "$AA9NN"
    section = "2"
    title = "a command that nothing was made of yet"

    channel: parts.NewAddress


@frozen
class ReadFirst(modbus.Request[modbus.TypeCodeSetting]):
    pdu = "46 07 00 channel"
    section = "3"
    title = "a request that nothing was made of yet"

    channel: items.Byte


@pytest.mark.parametrize("kind", [SetFirst, ReadFirst], ids=["dcon", "modbus"])
def test_the_first_error_of_a_class_is_raised_where_the_others_are(kind: Any) -> None:
    traces = []
    for _ in range(2):
        with pytest.raises(EncodeError) as caught:
            kind(0x01, -1)
        traces.append([frame.name for frame in traceback.extract_tb(caught.value.__traceback__)])

    first, second = traces
    assert first == second


@pytest.mark.parametrize("kind", [*dcon.COMMANDS, *modbus.REQUESTS], ids=lambda kind: kind.__name__)
def test_every_message_class_shows_what_it_was_compiled_to(kind: Any) -> None:
    source = kind.layout.source

    assert source.startswith("def construct(self")
    assert "def encode(m, p):" in source
    assert "def decode(" in source

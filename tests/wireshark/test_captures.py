"""Captures as people have them: recorded by `i7000 listen`, from networks, without directions, with nothing known."""

import re
import shutil
import struct
from pathlib import Path

import pytest

from i7000.modbus import crc16
from tests.terminal import Run, plain, run
from tests.test_cli_listen import listened
from tests.wireshark import DCON, DISSECTOR, ETHERNET, RTU, Frame, Seen, dissect, options, tshark, write_capture

__all__ = ["plain", "run"]

KNOWN = ("dcon.message", "dcon.fault", "i7000.message", "i7000.fault")


def messages(seen: list[Seen], *fields: str) -> list[str]:
    """Return names or faults, one for each packet."""
    return ["".join(it[field][0] for field in fields if it[field]) for it in seen]


def line(folder: Path, *texts: str, preferences: dict[str, str], fields: tuple[str, ...]) -> list[Seen]:
    """Dissect a capture of a DCON line without directions."""
    capture = folder / "line.pcapng"
    write_capture(capture, [DCON], [Frame(f"{text}\r".encode()) for text in texts])
    return dissect(folder, capture, fields, *options(**preferences))


def framed(body: str) -> bytes:
    """Return a frame of Modbus RTU with its CRC."""
    return bytes.fromhex(body) + crc16(bytes.fromhex(body)).to_bytes(2, "little")


def test_what_listen_records_of_both_protocols_is_named(
    run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    capture = tmp_path / "bus.pcapng"
    traffic = (
        (1.0, b"$022\r"), (0.05, b"!02080600\r"), (1.0, b"#02\r"), (0.05, b">" + b"+01.500" * 8 + b"\r"),
        (1.0, framed("014600")), (0.05, framed("01460000701900")),
        (1.0, framed("010400000002")), (0.05, framed("01040400017fff")),
        (1.0, framed("000501040000")),
    )  # fmt: skip
    assert listened(run, monkeypatch, *traffic, options=("--pcap", str(capture))).code == 0

    preferences = {
        "i7000_model": "M-7019R", "i7000_modbus_format": "engineering", "i7000_modules": "2=I-7018,type=V_2_5",
    }  # fmt: skip
    fields = (*KNOWN, "dcon.reading.value", "i7000.reading.status", "i7000.item.name", "i7000.name")
    seen = dissect(tmp_path, capture, fields, *options(**preferences))

    assert messages(seen, *KNOWN) == [
        "ReadConfiguration", "Configuration", "ReadAnalogInputs", "AnalogInputs", "ReadModuleName", "ModuleName",
        "ReadInputRegisters", "InputRegisters", "WriteSingleCoil",
    ]  # fmt: skip
    assert seen[3]["dcon.reading.value"] == ["1.5"] * 8
    assert seen[5]["i7000.name"] == ["00701900"]
    assert seen[7]["i7000.reading.status"] == ["ok", "over_range"]
    assert seen[8]["i7000.item.name"] == ["host_watchdog_enabled"]


def test_the_plug_in_folder_is_enough(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    write_capture(capture, [DCON], [Frame(b"$012\r")])
    folder = tmp_path / ".local/lib/wireshark/plugins"
    folder.mkdir(parents=True)
    shutil.copy(DISSECTOR, folder)

    assert "ReadConfiguration" in tshark(tmp_path, capture, script=False)


def test_the_general_preferences_are_for_every_module(tmp_path: Path) -> None:
    preferences = {
        "i7000_model": "M-7019R", "i7000_types": "K", "i7000_format": "percent", "i7000_errata": "FALSE",
    }  # fmt: skip
    text = "+050.00" * 8
    seen = line(
        tmp_path, "#07", f">{text}", preferences=preferences, fields=("dcon.reading.value", "dcon.reading.unit")
    )

    assert [float(value) for value in seen[1]["dcon.reading.value"]] == [686.0] * 8
    assert seen[1]["dcon.reading.unit"] == ["degC"] * 8


@pytest.mark.parametrize(
    "modules",
    ["I-7099", "1=I-7018,type=XX", "300000000=", "I-7018@B", "I-7018,speed=1", "x=I-7018", "I-7018,checksum=2"],
)
def test_an_invalid_preference_is_named_in_every_packet(modules: str, tmp_path: Path) -> None:
    seen = line(tmp_path, "$012", preferences={"i7000_modules": modules}, fields=("dcon.message", "_ws.expert.message"))

    assert seen[0]["dcon.message"] == ["ReadConfiguration"]
    assert any(text.startswith("Preference: ") for text in seen[0]["_ws.expert.message"])


def test_with_nothing_known_checksums_are_found_and_readings_keep_their_numbers(tmp_path: Path) -> None:
    texts = ("$012B7", "!01050600AD", "$012B8", "$012", "!01050600", "#01", ">+025.12+020.45", ">+025.12", "!01", "?01")
    fields = ("dcon.message", "dcon.fault", "dcon.checksum", "dcon.reading.value", "dcon.address", "dcon.response_to")
    seen = line(tmp_path, *texts, preferences={"i7000_errata": "FALSE"}, fields=fields)

    assert [it["dcon.checksum"] for it in seen[:5]] == [["B7"], ["AD"], ["B8"], [], []]
    assert [it["dcon.fault"] for it in seen[:5]] == [[], [], ["checksum"], [], []]
    assert [it["dcon.message"] for it in seen] == [
        ["ReadConfiguration"], ["Configuration"], ["ReadConfiguration"], ["ReadConfiguration"], ["Configuration"],
        ["ReadAnalogInputs"], ["AnalogInputs"], ["AnalogInputs"], [], [],
    ]  # fmt: skip
    assert [it["dcon.reading.value"] for it in seen[6:8]] == [["25.12", "20.45"], ["25.12"]]
    assert [it["dcon.response_to"] for it in seen[5:]] == [[], ["6"], [], [], []]
    assert [it["dcon.address"] for it in seen[8:]] == [["0x01"], ["0x01"]]


def test_a_command_that_depends_on_the_model_says_so(tmp_path: Path) -> None:
    (seen,) = line(tmp_path, "$01A", preferences={}, fields=("_ws.expert.message",))

    assert "On other models this is ReadCjcUpdate" in seen["_ws.expert.message"]


def test_a_command_that_the_model_does_not_have_is_named(tmp_path: Path) -> None:
    (seen,) = line(tmp_path, "$013", preferences={"i7000_model": "I-7017"}, fields=("_ws.expert.message",))

    assert seen["_ws.expert.message"] == ["The model does not have the command: ReadCjcTemperature"]


def packet(payload: bytes, *, to_server: bool, sequence: int, port: int) -> bytes:
    """Return an Ethernet frame with TCP data between a host and a server."""
    ports = (40_000, port) if to_server else (port, 40_000)
    tcp = struct.pack(">HHIIBBHHH", *ports, sequence, 1, 0x50, 0x18, 8192, 0, 0)
    ends = (b"\x0a\0\0\1", b"\x0a\0\0\2")
    source, destination = ends if to_server else ends[::-1]
    length = 20 + len(tcp) + len(payload)
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, length, 1, 0x4000, 64, 6, 0, source, destination)
    return bytes(6) + b"\2\0\0\0\0\1" + b"\x08\0" + ip + tcp + payload


def test_dcon_over_tcp_is_put_together_from_segments(tmp_path: Path) -> None:
    capture = tmp_path / "tcp.pcapng"
    segments = [(b"xx$0", True), (b"12\r", True), (b"!0105", False), (b"0600\r", False), (b"$01M\r#**\r", True)]
    sequences = {True: 1, False: 1}
    frames = []
    for payload, to_server in segments:
        data = packet(payload, to_server=to_server, sequence=sequences[to_server], port=10_001)
        frames.append(Frame(data))
        sequences[to_server] += len(payload)
    write_capture(capture, [ETHERNET], frames)

    fields = ("dcon.message", "dcon.noise", "dcon.response_to")
    seen = dissect(tmp_path, capture, fields, *options(dcon_tcp_port="10001"))
    as_chosen = dissect(tmp_path, capture, fields, "-d", "tcp.port==10001,dcon")

    assert [it["dcon.message"] for it in seen] == [
        [], ["ReadConfiguration"], [], ["Configuration"], ["ReadModuleName", "SynchronizedSampling"],
    ]  # fmt: skip
    assert seen[1]["dcon.noise"] == ["7878"]
    assert seen[3]["dcon.response_to"] == ["2"]
    assert seen == as_chosen


def test_46h_is_named_in_modbus_tcp_and_other_functions_once_the_model_is_known(tmp_path: Path) -> None:
    capture = tmp_path / "tcp.pcapng"
    exchanges = ("01460500", "0146050006000000010000", "010400000001", "0104027fff")
    frames, sequences = [], {True: 1, False: 1}
    for number, text in enumerate(exchanges):
        body = bytes.fromhex(text)
        payload = struct.pack(">HHH", number // 2, 0, len(body)) + body
        to_server = number % 2 == 0
        frames.append(Frame(packet(payload, to_server=to_server, sequence=sequences[to_server], port=502)))
        sequences[to_server] += len(payload)
    write_capture(capture, [ETHERNET], frames)

    fields = ("i7000.message", "i7000.line_settings", "i7000.response_to", "i7000.item")
    unknown = dissect(tmp_path, capture, fields)
    known = dissect(tmp_path, capture, fields, *options(i7000_model="M-7017"))

    named = [["ReadCommunicationSettings"], ["CommunicationSettings"]]
    assert [it["i7000.message"] for it in unknown] == [*named, [], []]
    assert [it["i7000.message"] for it in known] == [*named, ["ReadInputRegisters"], ["InputRegisters"]]
    assert unknown[1]["i7000.line_settings"] == ["0x06"]
    assert unknown[1]["i7000.response_to"] == ["1"]
    assert known[3]["i7000.item"] == ["30001"]


def test_rtu_without_directions_is_paired_by_what_was_asked(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    bodies = ("014625", "014625ff", "010600010002", "010600010002", "010400000001", "028402")
    write_capture(capture, [RTU], [Frame(framed(body)) for body in bodies])

    seen = dissect(tmp_path, capture, ("i7000.message", "i7000.fault"))

    assert messages(seen, "i7000.message", "i7000.fault") == [
        "ReadChannelMask", "ChannelMask", "WriteSingleRegister", "SingleRegisterWritten", "ReadInputRegisters",
        "function",
    ]  # fmt: skip


def test_a_repeated_request_without_directions_is_no_response(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    read, answer = "010400000008", "010410" + "0001" * 8
    bodies = (read, read, read, answer, "014625", "014625", "014625ff", read, "0104", "01840200")
    write_capture(capture, [RTU], [Frame(framed(body)) for body in bodies])

    seen = dissect(tmp_path, capture, ("i7000.message", "i7000.fault", "i7000.response_to"))

    assert messages(seen, "i7000.message", "i7000.fault") == [
        *["ReadInputRegisters"] * 3, "InputRegisters", *["ReadChannelMask"] * 2, "ChannelMask", "ReadInputRegisters",
        "length", "length",
    ]  # fmt: skip
    assert [it["i7000.response_to"] for it in seen] == [[], [], [], ["3"], [], [], ["6"], [], ["8"], ["8"]]


def test_link_types_can_be_left_to_other_dissectors(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    write_capture(capture, [RTU, DCON], [Frame(framed("014625")), Frame(b"$012\r", None, 1)])
    others = options(dcon_link_type="FALSE", i7000_rtu_link_type="FALSE")

    assert messages(dissect(tmp_path, capture, KNOWN, *others), *KNOWN) == ["", ""]


def test_the_second_pass_links_commands_to_their_responses(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    write_capture(capture, [DCON], [Frame(b"$012\r"), Frame(b"!01050600\r")])

    seen = dissect(tmp_path, capture, ("dcon.response_in", "dcon.response_to", "dcon.time"), "-2")

    assert [list(it.values())[:3] for it in seen] == [[["2"], [], []], [[], ["1"], ["1"]]]


def test_the_guide_shows_what_tshark_prints(tmp_path: Path) -> None:
    capture = tmp_path / "bus.pcapng"
    frames = [
        Frame(b"$012\r", True, 1), Frame(b"!01050600\r", False, 1), Frame(b"#01\r", True, 1),
        Frame(b">+1.2345+0.0000+9999.9" + b"+0.0000" * 5 + b"\r", False, 1), Frame(b"~013164B3\r", True, 1),
        Frame(framed("02462b00"), True), Frame(framed("02462bff9c"), False), Frame(framed("020601e80064"), True),
    ]  # fmt: skip
    write_capture(capture, [RTU, DCON], frames)
    known = options(i7000_modules="1=I-7018 2=M-7019R")
    guide = (DISSECTOR.with_name("README.md")).read_text("utf-8")
    summary, details = (block.splitlines() for block in re.findall(r"```text\n(.*?)```", guide, re.DOTALL))

    printed = tshark(tmp_path, capture, *known).splitlines()
    assert summary == [re.sub(r".*?(?=->|<-)", "", line, count=1) for line in printed]
    shown = set(tshark(tmp_path, capture, *known, "-O", "dcon,i7000").splitlines())
    assert [line for line in details if line not in shown] == []


def test_every_preference_and_filter_of_the_guide_exists(tmp_path: Path) -> None:
    guide = (DISSECTOR.with_name("README.md")).read_text("utf-8")
    capture = tmp_path / "line.pcapng"
    write_capture(capture, [DCON], [Frame(b"$012\r")])
    preferences, filters = (
        guide.partition(f"## {name}")[2].partition("\n## ")[0] for name in ("Preferences", "Filters")
    )
    named = re.findall(r"^\| `((?:i7000|dcon)\.\w+)` \|", preferences, re.MULTILINE)
    stated = re.findall(r"^(i7000|dcon)\.prefs\.(\w+) = ", DISSECTOR.read_text("utf-8"), re.MULTILINE)
    fields = set(re.findall(r"\b(?:i7000|dcon)\.[a-z_.]+\b", filters))

    assert sorted(f"{protocol}.{name}" for protocol, name in stated) == sorted(named)
    assert len(fields) > 15
    assert len(dissect(tmp_path, capture, sorted(fields))) == 1


READING = ("dcon.reading", "dcon.reading.value", "dcon.reading.unit", "dcon.fault")


def readings(seen: Seen) -> list[str]:
    """Return the readings of a packet in words."""
    return [
        f"{value} {unit}" for value, unit in zip(seen["dcon.reading.value"], seen["dcon.reading.unit"], strict=True)
    ]


def test_format_and_types_are_taken_from_what_the_line_shows(tmp_path: Path) -> None:
    texts = ("#01", ">+050.00+050.00", "$012", "!010F0601", "#01", ">+050.00+050.00", "$018C1", "!01C1R05", "#01")
    seen = line(tmp_path, *texts, ">+050.00+050.00", "#02", ">+050.00+050.00", preferences={}, fields=READING)

    assert [seen[at]["dcon.reading.value"] for at in (1, 11)] == [["50", "50"], ["50", "50"]]
    assert [seen[at]["dcon.reading.unit"] for at in (1, 11)] == [[], []]
    assert [readings(seen[at]) for at in (5, 9)] == [["686 degC", "686 degC"], ["686 degC", "1.25 V"]]


def test_what_a_module_acknowledges_is_learned_too(tmp_path: Path) -> None:
    hexadecimal, percent = ("%0102080602", "!02"), ("%02010F0601", "!01")
    texts = ("$012", "!01080600", *hexadecimal, "#02", ">4000C000", *percent, "#01", ">+050.00+050.00")
    channel = ("$017C1R05", "!01", "#01", ">+050.00+050.00", "%0101080600", "?01", "#01", ">+050.00+050.00")
    seen = line(tmp_path, *texts, *channel, "#02", ">4000", preferences={}, fields=READING)

    assert not any(it["dcon.fault"] for it in seen)
    assert [it[:8] for it in seen[5]["dcon.reading.value"]] == ["5.000152", "-5"]
    assert seen[5]["dcon.reading.unit"] == ["V", "V"]
    assert readings(seen[9]) == ["686 degC", "686 degC"]
    assert [readings(seen[at]) for at in (13, 17)] == [["686 degC", "1.25 V"]] * 2
    assert seen[19]["dcon.reading.unit"] == []


@pytest.mark.parametrize(
    ("learned", "reading", "value"),
    [("00", ">4000", []), ("01", ">+1.2345", ["1.2345"]), ("02", ">+1.2345", ["1.2345"])],
)
def test_what_was_learned_is_dropped_when_a_response_does_not_fit_it(
    tmp_path: Path, learned: str, reading: str, value: list[str]
) -> None:
    texts = ("$012", f"!010806{learned}", "#01", reading, "#01", ">+1.2345", "#01", ">12345")
    seen = line(tmp_path, *texts, preferences={}, fields=READING)

    assert [it["dcon.fault"] for it in seen] == [[]] * 7 + [["length"]]
    assert [seen[at]["dcon.reading.value"] for at in (3, 5)] == [value, ["1.2345"]]
    assert [seen[at]["dcon.reading.unit"] for at in (3, 5)] == [[], []]


def test_a_response_that_does_not_fit_the_format_that_is_set_has_a_fault(tmp_path: Path) -> None:
    preferences = {"i7000_types": "V_10", "i7000_format": "engineering"}
    seen = line(tmp_path, "$012", "!01080602", "#01", ">4000", preferences=preferences, fields=READING)

    assert [it["dcon.fault"] for it in seen] == [[], [], [], ["length"]]


def test_a_second_pass_reads_each_packet_with_what_was_known_at_its_time(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    texts = ("#01", ">+050.00", "$012", "!010F0601", "#01", ">+050.00")
    write_capture(capture, [DCON], [Frame(f"{text}\r".encode()) for text in texts])

    assert dissect(tmp_path, capture, READING) == dissect(tmp_path, capture, READING, "-2")


def test_what_is_set_goes_before_what_the_line_shows(tmp_path: Path) -> None:
    texts = ("$012", "!010F0601", "#01", ">+050.00")
    preferences = {"i7000_types": "V_10", "i7000_format": "percent"}
    seen = line(tmp_path, *texts, preferences=preferences, fields=READING)

    assert readings(seen[3]) == ["5 V"]


def test_hex_readings_are_known_by_their_look(tmp_path: Path) -> None:
    seen = line(tmp_path, "#01", ">7FFF    8000", ">7FFF", preferences={"i7000_types": "V_10"}, fields=READING)

    assert [it["dcon.reading"] for it in seen] == [[], ["7FFF", "    ", "8000"], ["7FFF"]]
    assert [it["dcon.reading.value"] for it in seen[1:]] == [["10", "-10"], ["10"]]
    assert not any(it["dcon.fault"] for it in seen)


def test_a_response_to_an_invalid_request_is_read_all_the_same(tmp_path: Path) -> None:
    capture = tmp_path / "line.pcapng"
    write_capture(capture, [RTU], [Frame(framed("0146250000"), True), Frame(framed("014625ff"), False)])

    seen = dissect(tmp_path, capture, ("i7000.fault", "i7000.message", "i7000.mask", "i7000.response_to"))

    assert list(seen[0].values())[:2] == [["length"], []]
    assert list(seen[1].values())[:4] == [[], ["ChannelMask"], ["0x0000ff"], ["1"]]

"""What reaches a pipe or a terminal, whatever characters are put in, as a process of its own."""

import json
import os
import pty
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from i7000.cli.text import Printer
from tests.spec.lint import Record
from tests.terminal import Run

SCRIPT = "import sys; from i7000.cli import main; sys.exit(main())"
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("FORCE_COLOR", "NO_COLOR")} | {
    "TERM": "xterm-256color",
    "PYTHONUTF8": "1",
}

STYLES = re.compile(r"\x1b\[[0-9;]*m")
"""How rich colours what it writes."""
CHARACTERS = [chr(code) for code in range(0x100)]
UNSEEN = [
    "\u00a0", "\u00ad", "\u034f", "\u061c", "\u115f", "\u180e", "\u200b", "\u200d", "\u200f", "\u2028", "\u2029",
    "\u202a", "\u202e", "\u2060", "\u2066", "\u2069", "\u3164", "\ufe0f", "\ufeff", "\ufff9", "\ue000",
    "\U000e0001", "\U000e0100",
]  # fmt: skip
"""Bidirectional controls, characters of no width, and others that are not seen."""

Call = Callable[..., tuple[str, str]]
"""Arguments and standard input -> what was written to standard output and error."""


def piped(*arguments: str | bytes, stdin: bytes = b"") -> tuple[str, str]:
    """Run with pipes."""
    result = subprocess.run(  # noqa: S603
        [sys.executable, "-c", SCRIPT, *arguments], input=stdin, capture_output=True, check=False, env=ENVIRONMENT
    )
    return result.stdout.decode(), result.stderr.decode()


def on_a_terminal(*arguments: str | bytes, stdin: bytes = b"") -> tuple[str, str]:
    """Run with a pseudo-terminal for output and errors; both are what comes of it, without the colours."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(  # noqa: S603
        [sys.executable, "-c", SCRIPT, *arguments], stdin=subprocess.PIPE, stdout=theirs, stderr=theirs, env=ENVIRONMENT
    ) as process:
        os.close(theirs)
        assert process.stdin is not None
        process.stdin.write(stdin)
        process.stdin.close()
        shown = b""
        try:
            while piece := os.read(ours, 1 << 16):
                shown += piece
        except OSError:
            pass  # Linux: the other side is closed
    os.close(ours)
    text = STYLES.sub("", shown.decode().replace("\r\n", "\n"))
    return text, text


@pytest.fixture(params=[piped, on_a_terminal], ids=["pipe", "terminal"])
def call(request: pytest.FixtureRequest) -> Call:
    found: Call = request.param
    return found


def strange(text: str) -> set[str]:
    """The characters that no terminal should be given."""
    return {one for one in text if one != "\n" and (not one.isprintable() or one in UNSEEN)}


def escape(character: str) -> str:
    return character.encode("unicode_escape").decode()


def shown_lines(out: str) -> dict[int, str]:
    """The text of each line of a log, as it was printed."""
    return {int(found[1]): found[2] for found in re.finditer(r"^(\d+) +(.*)$", out, re.MULTILINE)}


# --- decode -----------------------------------------------------------------------------------------------------------

ASKS = {"dcon": "$01{}2", "rtu": "01{}04 00 00 00 01 31 CA"}
ENDS = ("\n", "\r")
"""Characters that end a line."""


@pytest.mark.parametrize("entrance", ["argument", "file", "stdin"])
@pytest.mark.parametrize("protocol", ["dcon", "rtu"])
def test_every_byte_and_character_of_a_log_is_shown_or_escaped(
    call: Call, protocol: str, entrance: str, tmp_path: Path
) -> None:
    def is_put(one: str) -> bool:
        return one not in ENDS and (one != "\0" or entrance != "argument")

    characters = list(filter(is_put, (*CHARACTERS, *UNSEEN)))
    texts = [ASKS[protocol].format(one).encode() for one in characters]
    lines = [ASKS[protocol].format(escape(one) if strange(one) else one) for one in characters]
    single = list(filter(is_put, CHARACTERS))
    texts += [b"$01%b2 XYZ" % one.encode("latin-1") for one in single]
    lines += [f"$01{one if ' ' <= one < chr(0x7F) else escape(one)}2 XYZ" for one in single]
    log = tmp_path / "strange.log"
    log.write_bytes(b"\n".join(texts))

    options = ["decode", "--protocol", protocol]
    if entrance == "argument":
        out, _ = call(*options, "--", *texts)
    elif entrance == "file":
        out, _ = call(*options, "--file", str(log))
    else:
        out, _ = call(*options, stdin=log.read_bytes())

    assert strange(out) == set()
    assert {number: line.rstrip() for number, line in enumerate(lines, 1)} == {
        number: line.rstrip() for number, line in shown_lines(out).items()
    }


@pytest.mark.parametrize("protocol", ["dcon", "rtu"])
def test_json_has_every_character_in_ascii(call: Call, protocol: str) -> None:
    put = [one for one in (*CHARACTERS, *UNSEEN) if one not in ENDS]
    texts = [f"foo {one} bar" for one in put]

    out, _ = call("decode", "--json", "--protocol", protocol, stdin="\n".join(texts).encode())

    lines = [line for line in out.splitlines() if line.startswith("{")]
    records: list[Record] = [json.loads(line) for line in lines]
    assert strange("\n".join(lines)) == set()
    assert all(line.isascii() for line in lines)
    assert texts == [record["text"] for record in records]


def test_a_carriage_return_alone_ends_a_line(call: Call) -> None:
    out, _ = call("decode", stdin=b"$012\r!01050600\r\n$01M\r\x1b[2J\r")

    assert shown_lines(out) == {1: "$012", 2: "!01050600", 3: "$01M", 4: r"\x1b[2J"}
    assert strange(out) == set()


def test_an_argument_that_is_no_utf_8_is_shown_in_its_bytes(call: Call) -> None:
    out, _ = call("decode", b"$01\xff\xc32", b"\xed\xb2\x80")

    assert shown_lines(out) == {1: r"$01\xff\xc32", 2: r"\xed\xb2\x80"}


# --- errors -----------------------------------------------------------------------------------------------------------

WORST = "g\x07h\x08i\x0bj\x0ck\x1b[2Jl\x7fm\u0085n\u009bo\u202ep\u200bq"
SHOWN = r"g\\+x07h\\+x08i\\+x0bj\\+x0ck\\+x1b\[2Jl\\+x7fm\\+x85n\\+x9bo\\+u202ep\\+u200bq"
ERRORS = [
    ["encode", WORST],
    ["encode", f"ReadConfiguration{WORST}", "address=1"],
    ["encode", "ReadConfiguration", f"address={WORST}"],
    ["encode", "ReadConfiguration", f"{WORST}=1"],
    ["encode", "ReadConfiguration", WORST],
    ["encode", "SetModuleName", "address=1", f"name={WORST}"],
    ["encode", "SetChannelTypeCode", "address=1", "channel=0", f"type_code={WORST}"],
    ["encode", "ReadCoils", "address=1", f"start={WORST}", "count=1", "--protocol", "rtu"],
    ["encode", "ReadConfiguration", "address=1", "--protocol", WORST],
    ["decode", "--model", WORST],
    ["decode", "--firmware", WORST],
    ["decode", "--type", WORST],
    ["decode", "--format", WORST],
    ["decode", "--file", WORST],
    ["decode", f"--{WORST}"],
    ["commands", "--model", WORST],
    ["commands", WORST],
    ["registers", "--model", WORST],
    ["registers", "--model", "M-7017", "--firmware", WORST],
    ["simulate", "--model", WORST],
    ["simulate", "--model", f"M-7017,{WORST}=1"],
    ["simulate", "--model", f"M-7017,address={WORST}"],
    ["simulate", "--model", "M-7017", "--signal", WORST],
    ["simulate", "--model", "M-7017", "--signal", f"0=csv:{WORST}"],
    ["simulate", "--model", "M-7017", "--fault", WORST],
    ["simulate", "--model", "M-7017", "--tcp", WORST],
    ["simulate", "--model", "M-7017", "--tcp", f"{WORST}:1"],
    ["simulate", "--model", "M-7017", "--seed", WORST],
    [WORST],
]


@pytest.mark.parametrize("arguments", ERRORS, ids=lambda it: " ".join(it).replace(WORST, "WORST"))
def test_an_error_shows_what_was_given_in_escapes(run: Run, arguments: list[str]) -> None:
    err = run(*arguments).err

    assert strange(err) == set()
    assert re.search(SHOWN, err)


@pytest.mark.parametrize("arguments", ERRORS[::5], ids=lambda it: " ".join(it).replace(WORST, "WORST"))
def test_an_error_of_a_process_is_escaped_too(call: Call, arguments: list[str]) -> None:
    _, err = call(*arguments)

    assert strange(err) == set()
    assert re.search(SHOWN, err)


@pytest.mark.parametrize("code", [*range(0x20), *range(0x7F, 0xA0)])
def test_a_control_character_of_an_error_is_escaped(
    code: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, start in (("0", ""), ("1", "\x1b")):
        monkeypatch.setenv("FORCE_COLOR", "1" if name == "1" else "")
        Printer().error(f"before {chr(code)} after")
        err = capsys.readouterr().err

        assert f"i7000: before {escape(chr(code))} after" in err
        assert err.startswith(start)


@pytest.mark.parametrize("output", ["decode", "commands"])
def test_off_a_terminal_rich_is_not_imported(output: str) -> None:
    script = (
        "import sys; from i7000.cli import main; main(sys.argv[1:]); "
        "print([name for name in sys.modules if name.partition('.')[0] == 'rich'], file=sys.stderr)"
    )
    arguments = ["decode", "$012", "foo"] if output == "decode" else ["commands"]
    result = subprocess.run(  # noqa: S603
        [sys.executable, "-c", script, *arguments], capture_output=True, check=True, env=ENVIRONMENT
    )

    assert result.stderr.splitlines()[-1] == b"[]"

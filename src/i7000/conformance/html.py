"""A report as one page: no script, no network, light and dark, for a screen and for paper.

Laws: everything that comes from the report is escaped. Checks without a problem are folded.
"""

from collections import Counter
from collections.abc import Iterable, Iterator
from html import escape
from typing import Any

from i7000.conformance.exports import reproduction
from i7000.conformance.report import Checked, Frame, Report, texts
from i7000.conformance.verdict import SkipReason, Verdict

__all__ = ["page"]

_OPEN = frozenset({Verdict.FAIL.value, Verdict.FLAKY.value, Verdict.ERROR.value, Verdict.PASS_GOOD_ONLY.value})
_CLASSES = {
    Verdict.PASS.value: "pass",
    Verdict.INFO.value: "info",
    Verdict.SKIP.value: "skip",
    Verdict.FAIL.value: "fail",
    Verdict.FLAKY.value: "fail",
    Verdict.ERROR.value: "fail",
}
"""The colours of verdicts; others are those of a warning."""
_MOST_FRAMES = 200
"""The most frames of a check that are shown."""

_STYLE = """
:root { color-scheme: light dark; --ink: #1c2024; --soft: #5b636b; --line: #d8dce0; --paper: #fff; --card: #f5f6f8;
  --pass: #14713d; --fail: #b3261e; --warn: #8a5300; --info: #1f5fa8; --skip: #6b727a; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8ea; --soft: #a3abb3; --line: #3a4047; --paper: #16181b;
  --card: #202327; --pass: #5fc98b; --fail: #ff8a80; --warn: #f0b35a; --info: #7fb6f5; --skip: #949ca4; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem; max-width: 70rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .25rem; } h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; }
p { margin: .25rem 0; overflow-wrap: anywhere; } a { color: inherit; }
.soft { color: var(--soft); } .mono, code, td.wire { font-family: ui-monospace, monospace; font-size: .9em; }
.banner { border-left: .4rem solid var(--pass); background: var(--card); padding: .75rem 1rem; margin: 1rem 0;
  color: var(--ink); }
.banner.fail { border-color: var(--fail); } .banner.warn { border-color: var(--warn); }
.banner b { font-size: 1.15rem; } .banner p + p { color: var(--ink); }
mark { background: var(--fail); color: var(--paper); padding: 0 .1rem; }
h3 { font-size: 1rem; margin: 1.25rem 0 .25rem; }
table { border-collapse: collapse; width: 100%; } th, td { text-align: left; vertical-align: top; padding: .3rem .5rem;
  border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
th { font-weight: 600; overflow-wrap: normal; } .facts th { width: 8rem; }
.scroll { overflow-x: auto; }
.v { font-weight: 600; white-space: nowrap; } .pass { color: var(--pass); } .fail { color: var(--fail); }
.warn { color: var(--warn); } .info { color: var(--info); } .skip { color: var(--skip); }
.matrix { display: grid; grid-template-columns: repeat(auto-fill, minmax(11rem, 1fr)); gap: .4rem; align-items: start; }
.matrix div { border: 1px solid var(--line); border-radius: .3rem; padding: .3rem .5rem; background: var(--card); }
.matrix a { text-decoration: none; font-size: 1.1rem; } .matrix b { margin-right: .3rem; }
details { border: 1px solid var(--line); border-radius: .3rem; margin: .35rem 0; background: var(--card); }
summary { cursor: pointer; padding: .4rem .6rem; display: flex; gap: .6rem; flex-wrap: wrap; }
summary .v { min-width: 8.5rem; } summary .id { font-family: ui-monospace, monospace; font-size: .9em;
  overflow-wrap: anywhere; } .body { padding: 0 .8rem .8rem; }
@media (max-width: 40rem) { body { padding: .75rem; font-size: 15px; } summary .v { min-width: 0; }
  .log tr { display: block; border-bottom: 1px solid var(--line); } .log td { display: block;
  border: 0; padding: .1rem .3rem; } .log th, .log td.at { display: none; }
  .stack tr { display: block; border-bottom: 1px solid var(--line); padding: .3rem 0; }
  .stack td { display: block; border: 0; padding: .05rem .3rem; } .stack th { display: none; }
  .facts th { width: 5.5rem; } .matrix { grid-template-columns: 1fr 1fr; } }
@media print { body { max-width: none; font-size: 11px; } details { break-inside: avoid; border: 0; }
  .matrix { grid-template-columns: repeat(6, 1fr); } }
"""


def page(report: Report) -> str:
    """Return the page of a report."""
    title = f"{_of(report.module, 'model')} at address {_address(report)}"
    parts = [
        '<!doctype html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>Conformance: {escape(title)}</title><style>{_STYLE}</style></head><body><main>",
        *_head(report, title),
        *_failures(report),
        *_matrix(report),
        *_open_points(report),
        *_checks(report),
        *_module(report),
        "</main></body></html>\n",
    ]
    return "\n".join(parts)


def _of(record: dict[str, Any], name: str) -> str:
    value = record.get(name)
    return "unknown" if value is None else str(value)


def _address(report: Report) -> str:
    address = report.module.get("address")
    return f"{address:02X}" if isinstance(address, int) else "unknown"


def _protocol(report: Report) -> str:
    protocol = _of(report.module, "protocol")
    return {"dcon": "DCON", "rtu": "Modbus RTU"}.get(protocol, protocol)


def _head(report: Report, title: str) -> Iterator[str]:
    counts = Counter(check.verdict for check in report.checks)
    bad = sum(counts[verdict] for verdict in _OPEN)
    left, restored = (texts(report.end or {}, name) for name in ("left_changed", "restored"))
    words, kind = ("all that ran passed", "pass") if counts[Verdict.PASS.value] else ("nothing was decided", "warn")
    if bad:
        words, kind = f"{bad} of {len(report.checks)} checks did not pass", "fail"
    if left:
        words, kind = f"the module was left changed: {', '.join(left)}", "fail"
    elif (report.end or {}).get("silent") is True:
        words, kind = "the module does not answer any more", "fail"
    if not report.is_complete:
        words, kind = f"INCOMPLETE: {words}", "warn" if kind == "pass" else kind
    yield f"<h1>{escape(title)}</h1>"
    start = report.start
    allowed = ", ".join(texts(start, "allowed"))
    versions = f"i7000 {_of(start, 'version')}; manual {_of(start, 'manual')}"
    facts = (
        f"firmware {_of(report.module, 'firmware')}, {_protocol(report)}, {_of(start, 'target')}",
        f"{_of(start, 'time')}; {versions}; seed {_of(start, 'seed')}; allowed: {allowed}",
        f"SHA-256 of spec: {_of(start, 'spec_sha256')}",
    )
    yield from (f'<p class="soft">{escape(fact)}</p>' for fact in facts)
    shown = ", ".join(f"{counts[it.value]} {it.value}" for it in Verdict if counts[it.value])
    yield f'<div class="banner {kind}"><p><b>{escape(words)}</b></p><p>{escape(shown)}</p>'
    if restored:
        yield f"<p>restored: {escape(', '.join(restored))}</p>"
    yield from (f'<p class="warn">{escape(problem)}</p>' for problem in report.problems)
    yield "</div>"


def _verdict(text: str) -> str:
    return f'<span class="v {_CLASSES.get(text, "warn")}">{escape(text)}</span>'


def _anchor(check_id: str) -> str:
    return escape(check_id.replace("/", "-"), quote=True)


def _failures(report: Report) -> Iterator[str]:
    failed = [check for check in report.checks if check.verdict in _OPEN or check.verdict == Verdict.WARN.value]
    if not failed:
        return
    yield '<h2>What did not pass</h2><div class="scroll"><table class="stack">'
    yield "<tr><th>verdict</th><th>check</th><th>why</th></tr>"
    for check in failed:
        link = f'<a href="#{_anchor(check.id)}"><code>{escape(check.id)}</code></a>'
        yield f"<tr><td>{_verdict(check.verdict)}</td><td>{link}</td><td>{escape(str(check['text'] or ''))}</td></tr>"
    yield "</table></div>"


_MARKS = {"pass": "&#10003;", "fail": "&#10007;", "info": "i", "skip": "&#183;"}


def _matrix(report: Report) -> Iterator[str]:
    """Yield the matrix: a field for each section, a mark for each of its checks."""
    by_section: dict[str, list[Checked]] = {}
    for check in report.checks:
        if not _is_foreign(check):
            for section in check.texts("sections"):
                by_section.setdefault(section, []).append(check)
    yield "<h2>By section of the manual</h2><p class=soft>&#10003; passed, &#10007; failed, ! see there,"
    yield " i open point, &#183; not carried out</p>"
    yield '<div class="matrix">'
    for section in sorted(by_section, key=_in_order):
        marks = "".join(_mark(check) for check in by_section[section])
        yield f"<div><b>{escape(section)}</b>{marks}</div>"
    yield "</div>"


def _mark(check: Checked) -> str:
    kind = _CLASSES.get(check.verdict, "warn")
    words = escape(f"{check.id}: {check.verdict}", quote=True)
    link = f'<a class="{kind}" href="#{_anchor(check.id)}" title="{words}" aria-label="{words}">'
    return f"{link}{_MARKS.get(kind, '!')}</a> "


def _in_order(section: str) -> list[tuple[int, int, str]]:
    return [(not part.isdecimal(), int(part) if part.isdecimal() else 0, part) for part in section.split(".")]


def _is_foreign(check: Checked) -> bool:
    """Return whether a check is about something that the module does not have."""
    return bool(check["reason"] == SkipReason.NOT_APPLICABLE.value)


def _open_points(report: Report) -> Iterator[str]:
    points = [check for check in report.checks if check.verdict == Verdict.INFO.value]
    if not points:
        return
    yield '<h2>Open points of the manual</h2><div class="scroll"><table class="stack">'
    yield "<tr><th>check</th><th>what the module does</th><th>errata</th></tr>"
    for check in points:
        errata = ", ".join(check.texts("errata"))
        yield (
            f"<tr><td><code>{escape(check.id)}</code></td><td>{escape(str(check['text'] or ''))}</td>"
            f"<td>{escape(errata)}</td></tr>"
        )
    yield "</table></div>"


# --- the checks -------------------------------------------------------------------------------------------------------


def _checks(report: Report) -> Iterator[str]:
    yield "<h2>The checks</h2>"
    group = ""
    for check in report.checks:
        if not _is_foreign(check):
            if group != check.id.partition("/")[0]:
                group = check.id.partition("/")[0]
                yield f"<h3>{escape(group)}</h3>"
            yield from _check(report, check)
    foreign = [check for check in report.checks if _is_foreign(check)]
    if foreign:
        yield f"<details><summary>{len(foreign)} checks of what the module does not have</summary><div class=body><p>"
        yield ", ".join(f"<code>{escape(check.id)}</code>" for check in foreign)
        yield "</p></div></details>"


def _check(report: Report, check: Checked) -> Iterator[str]:
    opened = " open" if check.verdict in _OPEN else ""
    yield f'<details id="{_anchor(check.id)}"{opened}><summary>{_verdict(check.verdict)}'
    yield f'<span class="id">{escape(check.id)}</span><span>{escape(str(check["title"] or ""))}</span></summary>'
    yield '<div class="body">'
    sections = ", ".join(check.texts("sections"))
    yield f"<p>{escape(str(check['requirement'] or ''))}</p>"
    errata = ", ".join(check.texts("errata"))
    about = f"manual {sections}; {check['level']}{f'; {errata}' if errata else ''}"
    yield f'<p class="soft">{escape(about)}</p>'
    rows = [*_facts(check)]
    if check.verdict in _OPEN:
        rows.append(("repeat", f"<code>{escape(reproduction(report, check.id))}</code>"))
    if rows:
        yield '<table class="facts">'
        yield from (f"<tr><th>{name}</th><td>{shown}</td></tr>" for name, shown in rows)
        yield "</table>"
    yield from _log(check.frames)
    yield "</div></details>"


def _facts(check: Checked) -> Iterator[tuple[str, str]]:
    """Yield what decided a check: names, and what is shown for them."""
    for name, title in (("text", "why"), ("reason", "reason")):
        if check[name] is not None:
            yield title, escape(str(check[name]))
    for name in ("wrote", "answered", "sent"):
        if (wire := _bytes(check[name])) is not None:
            yield name, f"<code>{escape(_wire(wire))}</code>"
    received, right = (_bytes(check[name]) for name in ("received", "right"))
    if received is not None:
        yield "received", f"<code>{_marked(received, right)}</code>"
    if check["expected"] is not None:
        yield "expected", escape(str(check["expected"]))
    if repeats := check.texts("repeats"):
        yield "repeated", escape(", ".join(repeats))


def _bytes(value: object) -> bytes | None:
    """Return the bytes of a field; None if it has none."""
    try:
        return bytes.fromhex(value) if isinstance(value, str) else None
    except ValueError:
        return None


def _marked(wire: bytes, right: bytes | None) -> str:
    """Return bytes with a mark at the first one that is not right."""
    pairs = zip(wire, right, strict=False) if right else ()
    at = next((at for at, (found, wanted) in enumerate(pairs) if found != wanted), None)
    if at is None:
        return escape(_wire(wire))
    hexes = [f"<mark>{byte:02x}</mark>" if place == at else f"{byte:02x}" for place, byte in enumerate(wire)]
    return escape(_wire(wire)).replace(wire.hex(" "), " ".join(hexes), 1)


def _wire(wire: bytes) -> str:
    """Return bytes in hex, and as text where they are text."""
    text = wire.removesuffix(b"\r")
    shown = f"  {text.decode('ascii')}" if text and all(0x20 <= byte < 0x7F for byte in text) else ""
    return f"{wire.hex(' ')}{shown}" if wire else "nothing"


def _log(frames: Iterable[Frame]) -> Iterator[str]:
    shown = list(frames)
    if not shown:
        return
    yield '<table class="log"><tr><th>s</th><th>from</th><th>bytes</th><th>what it means</th></tr>'
    for frame in shown[:_MOST_FRAMES]:
        who = "host" if frame.sent else "module"
        yield f'<tr><td class="at">{frame.seconds:.3f}</td><td>{who}</td>'
        yield f'<td class="wire">{escape(_wire(frame.wire))}</td><td>{escape(frame.words)}</td></tr>'
    yield "</table>"
    if len(shown) > _MOST_FRAMES:
        yield f"<p class=soft>and {len(shown) - _MOST_FRAMES} more</p>"


def _module(report: Report) -> Iterator[str]:
    settings = report.module.get("settings")
    if not isinstance(settings, dict):
        return
    yield "<h2>The module before the run</h2><details><summary>its settings</summary><div class=body><table>"
    for name, value in settings.items():
        yield f"<tr><th>{escape(str(name))}</th><td>{escape(str(value))}</td></tr>"
    yield "</table></div></details>"

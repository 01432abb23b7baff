"""The faults of lines on which procedures have to end, and to return nothing that is not so."""

from hypothesis import strategies as st

from i7000.simulator.faults import Faults


@st.composite
def faults(draw: st.DrawFn) -> Faults:
    """Draw the faults of a line: any of them, from rare to always, but for false answers, which no host can notice."""
    often = st.sampled_from((0.0, 0.0, 0.01, 0.1, 1.0))
    return Faults(
        echo=draw(st.booleans()),
        lumps=draw(st.booleans()),
        drop=draw(often),
        flip=draw(often),
        noise=draw(often),
        late=draw(often),
        late_by=draw(st.sampled_from((0.3, 0.05, 0.15))),
        silent=draw(often),
        truncate=draw(often),
        duplicate=draw(often),
    )

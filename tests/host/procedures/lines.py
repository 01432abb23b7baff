"""The faults of lines on which procedures have to end, and to return nothing that is not so."""

from random import Random

from attrs import frozen
from hypothesis import strategies as st

from i7000.simulator.faults import Faults


@frozen(kw_only=True)
class SingleFlips(Faults):
    """The faults of a line that flips at most one bit of a transmission: `flip` is the probability of it.

    A checksum, which is only a sum, sees every single flip, but not every two of them.
    """

    def carried(self, data: bytes, chance: Random) -> tuple[bytes, tuple[str, ...]]:
        if data and chance.random() < self.flip:
            at, bit = chance.randrange(len(data)), chance.randrange(8)
            data = data[:at] + bytes((data[at] ^ 1 << bit,)) + data[at + 1 :]
        return Faults(drop=self.drop, noise=self.noise).carried(data, chance)


@st.composite
def faults(draw: st.DrawFn) -> Faults:
    """Draw the faults of a line: any of them, from rare to always, but for false answers, which no host can notice."""
    often = st.sampled_from((0.0, 0.0, 0.01, 0.1, 1.0))
    return SingleFlips(
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

"""The entry point that Hypothesis calls when it is imported, so that `st.from_type` has every public class of `i7000`.

This module is outside the package because everyone who has both distributions imports it, and importing anything in the
package also imports attrs. It imports neither `i7000` nor its strategies: Hypothesis calls `resolve` when it needs a
strategy for the first class of the package, as it does for NumPy.

Laws: `register` never raises, whatever the version of Hypothesis.
"""

import warnings
from contextlib import suppress
from typing import Any, get_origin

NEEDED = (6, 120)
"""The first version of Hypothesis that the strategies work with: that of the extra ``hypothesis``."""


def register() -> None:
    """Register `resolve` with Hypothesis; warn if that is impossible."""
    try:
        reason = _register()
    except Exception as error:  # noqa: BLE001 - it is not for us to make an import of Hypothesis fail
        reason = repr(error)
    if reason:
        with suppress(UserWarning):  # where warnings are errors
            warnings.warn(f"st.from_type has no strategies for i7000: {reason}", stacklevel=2)


def _register() -> str:
    """Register `resolve`; return the reason if that is impossible, else an empty string."""
    from hypothesis.version import __version__, __version_info__  # noqa: PLC0415 - it is being imported

    if __version_info__ < NEEDED:
        return f"Hypothesis {'.'.join(map(str, NEEDED))} or later is needed, this is {__version__}"
    from hypothesis.strategies._internal import types  # noqa: PLC0415

    try:
        resolvers = types._global_extra_lookup  # noqa: SLF001
    except AttributeError:  # It is not documented. What is documented needs the classes.
        from i7000 import strategies  # noqa: PLC0415

        strategies.register()
    else:
        resolvers["i7000"] = resolve
    return ""


def resolve(thing: Any) -> Any:  # noqa: ANN401 - whatever `st.from_type` is asked for
    """Return the strategy for a class of `i7000`, or None for anything else."""
    kind = get_origin(thing) or thing  # of Command[Any]
    if not isinstance(kind, type) or not str(kind.__module__).startswith("i7000."):
        return None
    from i7000.strategies import strategy_for  # noqa: PLC0415 - the first that is asked for imports them

    return strategy_for(kind)

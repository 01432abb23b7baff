"""Models in words."""

from collections.abc import Iterable

from i7000 import dcon, modbus
from i7000.availability import Availability
from i7000.models import Model

__all__ = ["models_words"]


_AVAILABILITY: dict[str, Availability] = {
    kind.section: kind.availability for kinds in (dcon.COMMANDS, modbus.REQUESTS) for kind in kinds
}


def models_words(models: Iterable[Model], section: str) -> str:
    """Name models in few words; of all that have the command of a section, in the manual's words.

    >>> models_words(Model, "2.3"), models_words([Model.I_7017Z], "2.4")
    ('all models', 'I-7017Z')
    """
    models = set(models)
    if models == set(Model):
        return "all models"
    if section in _AVAILABILITY and models == set(_AVAILABILITY[section].gates):
        return _AVAILABILITY[section].scope
    others = set(Model) - models
    few = min(models, others, key=len)
    names = ", ".join(model.value for model in Model if model in few)
    return f"all but {names}" if few is others else names

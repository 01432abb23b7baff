"""The zoo: firmware with one seeded bug each, which the checks have to catch.

``python -m tests.conformance.zoo NAME`` plays one on standard input and output: a target for ``exec:``. Without a name
it lists them.
"""

from tests.conformance.zoo import dcon_animals, line_animals, rtu_animals
from tests.conformance.zoo.species import Species


def zoo() -> dict[str, Species]:
    """Return all animals, by their names."""
    return {
        **{f"dcon/{name}": animal for name, animal in dcon_animals.HERD.animals.items()},
        **{f"line/{name}": animal for name, animal in line_animals.HERD.animals.items()},
        **{f"rtu/{name}": animal for name, animal in rtu_animals.HERD.animals.items()},
    }

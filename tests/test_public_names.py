"""The public surface: what ``__all__`` names is there, is documented, and is the whole of it."""

import subprocess
import sys
from importlib.metadata import version
from types import FunctionType, ModuleType
from typing import Any

import attrs
import pytest

import i7000
from i7000 import conformance, dcon, device, host, modbus
from i7000.dcon.codec import COMMANDS
from i7000.host import procedures
from tests.spec.lint import SPEC, rows

MODULES = [i7000, conformance, dcon, modbus, device, host, procedures]


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_every_public_name_is_there_once(module: ModuleType) -> None:
    assert len(module.__all__) == len(set(module.__all__))
    assert all(hasattr(module, name) for name in module.__all__)


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_nothing_public_is_left_out(module: ModuleType) -> None:
    public = {
        name for name, value in vars(module).items() if not name.startswith("_") and not isinstance(value, ModuleType)
    }

    assert set(module.__all__) == public


@pytest.mark.parametrize(
    ("module", "name"), [(module, name) for module in MODULES for name in module.__all__ if name[0].isalpha()]
)
def test_every_public_class_and_function_is_documented(module: ModuleType, name: str) -> None:
    value = getattr(module, name)
    if isinstance(value, type | FunctionType):
        assert value.__doc__
        assert not value.__doc__.startswith(f"{name}(")


@pytest.mark.parametrize(
    ("module", "bases", "listed"),
    [(dcon, (dcon.Command, dcon.Broadcast), COMMANDS), (modbus, (modbus.Request,), modbus.REQUESTS)],
    ids=["dcon", "modbus"],
)
def test_every_public_command_is_listed_once(module: ModuleType, bases: Any, listed: Any) -> None:
    public = [getattr(module, name) for name in module.__all__]
    commands = {it for it in public if isinstance(it, type) and issubclass(it, bases) and hasattr(it, "section")}

    assert set(listed) == commands
    assert len(listed) == len(commands)


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.__name__)
def test_a_command_states_its_wire_form_and_its_source(command: Any) -> None:
    document = command.__doc__

    assert f"Wire: ``{command.syntax}``" in document
    assert f"Manual: {command.section}" in document


@pytest.mark.parametrize("request_class", modbus.REQUESTS, ids=lambda kind: kind.__name__)
def test_a_request_and_its_response_state_their_wire_forms_and_their_source(request_class: Any) -> None:
    response = request_class.response

    assert f"Wire: ``{request_class.pdu}`` -> ``{response.pdu}``\n" in request_class.__doc__
    assert f"Wire: ``{response.pdu}``\n" in response.__doc__
    assert f"Manual: {request_class.section}" in request_class.__doc__
    assert f"Manual: {request_class.section}" in response.__doc__


@pytest.mark.parametrize("kind", [*COMMANDS, *modbus.REQUESTS], ids=lambda kind: kind.__name__)
def test_a_message_is_frozen(kind: Any) -> None:
    message = object.__new__(kind)

    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        message.address = 1


@pytest.mark.parametrize("section", [row["section"] for row in rows("dcon_commands")])
def test_every_section_of_chapter_2_has_its_class_its_row_and_its_vectors(section: str) -> None:
    assert [command.section for command in COMMANDS].count(section) == 1
    assert [row["section"] for row in rows("dcon_commands")].count(section) == 1
    assert len(list((SPEC / "vectors" / "dcon").glob(f"{section}-*.json"))) == 1


@pytest.mark.parametrize("section", [row["section"] for row in rows("module_settings")])
def test_every_sub_function_has_its_class_its_row_and_its_vectors(section: str) -> None:
    (request_class,) = (it for it in modbus.REQUESTS if it.section == section)

    assert [row["section"] for row in rows("module_settings")].count(section) == 1
    assert len(list((SPEC / "vectors" / "modbus").glob(f"46-{request_class.sub_function:02X}-*.json"))) == 1


@pytest.mark.parametrize(
    "request_class", [it for it in modbus.REQUESTS if it.sub_function is None], ids=lambda kind: kind.__name__
)
def test_every_function_has_its_row_and_its_vectors(request_class: Any) -> None:
    code = f"{request_class.function:02X}"

    assert [row["function"] for row in rows("modbus_functions")].count(code) == 1
    assert len(list((SPEC / "vectors" / "modbus").glob(f"{code}-*.json"))) == 1


def test_the_version_is_that_of_the_installed_package() -> None:
    assert i7000.__version__ == version("i7000")


def test_importing_the_package_imports_no_extra() -> None:
    unwanted = {"hypothesis", "rich", "cyclopts", "asyncio", "socket", "json", "logging"}
    script = f"import sys, i7000.dcon, i7000.modbus; print(sorted({unwanted} & set(sys.modules)))"

    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)  # noqa: S603

    assert found.stdout == "[]\n"

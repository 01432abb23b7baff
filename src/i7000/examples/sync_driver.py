"""A program without an event loop that reads the inputs of a module: `i7000.link.Line`."""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

from collections.abc import Sequence

from i7000.examples.task import failures_reported, program, read_task
from i7000.host.procedures import ask
from i7000.link import Line

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the inputs of modules."""
    task = read_task(arguments)
    with failures_reported(), Line.open(task.target, task.line, echo=task.echo) as line:
        return max(task.show(command, line.run(ask(command, task.profile))) for command in task.requests())


if __name__ == "__main__":
    raise SystemExit(program(main))

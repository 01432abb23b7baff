"""A program with an event loop that reads the inputs of a module: `i7000.link.AsyncLine`."""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

import asyncio
from collections.abc import Sequence

from i7000.examples.task import Task, failures_reported, program, read_task
from i7000.host.procedures import ask
from i7000.link import AsyncLine

__all__ = ["main"]


async def _main(task: Task) -> int:
    async with await AsyncLine.open(task.target, task.line, echo=task.echo) as line:
        return max([task.show(command, await line.run(ask(command, task.profile))) for command in task.requests()])


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the inputs of modules."""
    task = read_task(arguments)
    with failures_reported():
        return asyncio.run(_main(task))


if __name__ == "__main__":
    raise SystemExit(program(main))

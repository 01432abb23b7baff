"""Threads beside an event loop: one for the blocking calls of a port; and work that another thread hands to the loop.

Laws: calls are carried out in order. The thread is a daemon: a call that never returns delays neither the event loop
nor the end of the program.
"""

import asyncio
from collections.abc import Callable, Coroutine
from concurrent.futures import CancelledError
from contextlib import suppress
from functools import partial
from queue import SimpleQueue
from threading import Thread
from typing import Any, TypeVar

__all__ = ["Worker", "done_in"]

T = TypeVar("T")


class Worker:
    """A thread that carries out calls; `end` makes it end."""

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._calls: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        Thread(target=self._work, name="i7000 port", daemon=True).start()

    def call(self, function: Callable[[], T]) -> "asyncio.Future[T]":
        """Return the future result of a call in the thread; its exception need not be fetched."""
        future: asyncio.Future[T] = self._loop.create_future()
        future.add_done_callback(lambda done: done.cancelled() or done.exception())

        def carry_out() -> None:
            try:
                result = function()
            except Exception as error:  # noqa: BLE001 - whoever waits gets it
                self._deliver(partial(future.set_exception, error))
            else:
                self._deliver(partial(future.set_result, result))

        self._calls.put(carry_out)
        return future

    def end(self) -> None:
        """End the thread after the calls so far."""
        self._calls.put(None)

    def _deliver(self, result: Callable[[], None]) -> None:
        with suppress(RuntimeError):  # the event loop has ended
            self._loop.call_soon_threadsafe(result)

    def _work(self) -> None:
        while carry_out := self._calls.get():
            carry_out()


def done_in(loop: asyncio.AbstractEventLoop, coroutine: Coroutine[Any, Any, object]) -> bool:
    """Wait in another thread until a loop has carried out a coroutine; return False if the loop ended before."""
    try:
        future = asyncio.run_coroutine_threadsafe(coroutine, loop)
    except RuntimeError:
        coroutine.close()
        return False
    try:
        future.result()
    except CancelledError:
        return False
    return True

"""The worker: whatever happens in the child, the program goes on."""

import ctypes
import math
import operator
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hullquad import worker
from hullquad.errors import MeshingError
from hullquad.worker import WorkerError

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits the memory of a process")
POSIX = pytest.mark.skipif(os.name != "posix", reason="needs POSIX signals")


def call(function: Callable[..., Any], *arguments: Any, seconds: float = 30.0, **options: Any) -> Any:
    return worker.call(function, *arguments, seconds=seconds, place="plate H1", **options)


def refusal(function: Callable[..., Any], *arguments: Any, **options: Any) -> WorkerError:
    with pytest.raises(WorkerError) as caught:
        call(function, *arguments, **options)
    assert "plate H1" in str(caught.value)
    assert call(math.sqrt, 4.0) == 2.0, "the next call works"
    return caught.value


@pytest.fixture
def stopped() -> Iterator[None]:
    """No child runs, neither before nor after the test."""
    worker.stop()
    yield
    worker.stop()


def test_a_call_returns_what_the_function_returns() -> None:
    assert call(divmod, 17, 5) == (3, 2)


def test_arrays_come_back_bit_for_bit() -> None:
    values = np.random.default_rng(1).normal(size=(50_000, 2))
    assert np.array_equal(call(np.negative, values), -values)


def test_calls_run_in_another_process() -> None:
    assert call(os.getpid) != os.getpid()


def test_the_same_child_answers_the_next_call() -> None:
    assert call(os.getpid) == call(os.getpid)


def test_an_error_of_ours_arrives_as_itself() -> None:
    error = MeshingError("E_TEST", "plate H7", edge=3)
    raises = "def f(p):\n import pickle\n raise pickle.loads(p)\nf(p)"
    with pytest.raises(MeshingError) as caught:
        call(exec, raises, {"p": pickle.dumps(error)})
    assert (caught.value.code, caught.value.place, caught.value.numbers) == ("E_TEST", "plate H7", {"edge": 3})


def test_any_other_error_is_described_in_one_line() -> None:
    error = refusal(operator.truediv, 1, 0)
    assert error.code == "E_WORKER"
    assert error.numbers == {"reason": "ZeroDivisionError: division by zero"}


def test_the_traceback_of_the_child_is_kept_as_a_note() -> None:
    assert "Traceback" in refusal(operator.truediv, 1, 0).__notes__[0]


def test_a_function_that_exits_is_an_error() -> None:
    assert refusal(sys.exit, 3).code == "E_WORKER"


def test_a_result_that_cannot_be_pickled_is_an_error() -> None:
    assert refusal(memoryview, b"x").code == "E_WORKER"


def test_a_crash_costs_the_child_only() -> None:
    assert refusal(os.abort).code == "E_CRASH"


@POSIX
def test_a_crash_names_its_signal() -> None:
    assert "SIGSEGV" in refusal(ctypes.string_at, 0).text


def test_an_exit_without_a_word_is_a_crash() -> None:
    assert "exit status 7" in refusal(os._exit, 7).text


@LINUX
def test_a_child_that_died_between_two_calls_is_replaced_silently() -> None:
    child = call(os.getpid)
    os.kill(child, signal.SIGKILL)
    wait_for_the_end_of(child)
    assert call(math.sqrt, 4.0) == 2.0


def test_a_hanging_call_ends_at_its_time_limit() -> None:
    begin = time.monotonic()
    assert refusal(time.sleep, 60, seconds=0.2).code == "E_TIME"
    assert time.monotonic() - begin < 10


def test_c_code_that_never_returns_ends_at_its_time_limit() -> None:
    assert refusal(pow, 3, 10**9, seconds=0.2).code == "E_TIME"


@LINUX
def test_memory_beyond_the_limit_is_refused() -> None:
    assert refusal(bytearray, 10**9, memory=10**8).code == "E_MEMORY"


@LINUX
def test_the_memory_limit_counts_growth_only() -> None:
    assert len(call(bytes, 10**7, memory=3 * 10**7)) == 10**7


@LINUX
def test_the_memory_limit_ends_with_its_call() -> None:
    call(math.sqrt, 4.0, memory=10**6)
    assert len(call(bytes, 10**8)) == 10**8


def test_what_is_printed_in_the_child_does_not_disturb_its_answer() -> None:
    assert call(os.write, 1, b"Triangle speaks") == 15


def test_a_child_that_reads_its_standard_input_finds_it_empty() -> None:
    assert call(os.read, 0, 10) == b""


def test_cancelling_from_another_thread_ends_the_call() -> None:
    call(math.sqrt, 4.0)
    threading.Timer(0.2, worker.cancel).start()
    assert refusal(time.sleep, 60).code == "E_CANCELLED"


def test_cancelling_while_the_child_still_starts_ends_the_call(stopped: None) -> None:
    is_over = threading.Event()

    def cancel_until_it_ends() -> None:  # a call that has not begun cannot be cancelled
        while not is_over.wait(0.01):
            worker.cancel()

    canceller = threading.Thread(target=cancel_until_it_ends)
    canceller.start()
    try:
        with pytest.raises(WorkerError, match="E_CANCELLED"):
            call(time.sleep, 60)
    finally:
        is_over.set()
        canceller.join()
    assert call(math.sqrt, 4.0) == 2.0


def test_cancelling_without_a_call_does_nothing() -> None:
    worker.cancel()
    assert call(math.sqrt, 4.0) == 2.0


def test_calls_from_several_threads_get_their_own_answers() -> None:
    answers: dict[int, float] = {}

    def ask(number: int) -> None:
        answers[number] = call(math.sqrt, number * number)

    threads = [threading.Thread(target=ask, args=(number,)) for number in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == {number: number for number in range(20)}


def test_stopping_ends_a_running_call() -> None:
    call(math.sqrt, 4.0)
    threading.Timer(0.2, worker.stop).start()
    assert refusal(time.sleep, 60).code == "E_CANCELLED"


@POSIX
def test_stopping_leaves_no_process(stopped: None) -> None:
    child = call(os.getpid)
    worker.stop()
    with pytest.raises(ProcessLookupError):
        os.kill(child, 0)


def test_starting_does_not_wait(stopped: None) -> None:
    begin = time.monotonic()
    worker.start()
    assert time.monotonic() - begin < 0.1
    assert call(math.sqrt, 4.0) == 2.0


def test_starting_during_a_call_does_not_wait() -> None:
    call(math.sqrt, 4.0)
    thread = threading.Thread(target=call, args=(time.sleep, 0.5))
    thread.start()
    begin = time.monotonic()
    worker.start()
    assert time.monotonic() - begin < 0.3
    thread.join()


def test_the_child_finds_modules_that_only_the_path_of_its_parent_has(
    stopped: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "only_here_19.py").write_text("def answer():\n    return 42\n")
    monkeypatch.syspath_prepend(tmp_path)
    import only_here_19  # type: ignore[import-not-found]

    assert call(only_here_19.answer) == 42


def program(source: str, **options: Any) -> "subprocess.Popen[str]":
    """A script from standard input, without a guard."""
    process = subprocess.Popen(
        [sys.executable, "-W", "error", "-"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options,
    )  # fmt: skip
    assert process.stdin is not None
    process.stdin.write(textwrap.dedent(source))
    process.stdin.close()
    process.stdin = None
    return process


def test_a_script_without_a_guard_ends_clean() -> None:
    script = """
        import math
        from hullquad import worker
        print(worker.call(math.sqrt, 9.0, seconds=30, place="plate H1"))
    """
    output, errors = program(script).communicate(timeout=30)
    assert (output, errors) == ("3.0\n", "")


HANGING = """
    import os, time
    from hullquad import worker
    try:
        print(worker.call(os.getpid, seconds=30, place="plate H1"), flush=True)
        worker.call(time.sleep, 1.0, seconds=30, place="plate H1")
    except KeyboardInterrupt:
        print("interrupted", flush=True)
        print(worker.call(abs, -1, seconds=30, place="plate H1"))
"""


@POSIX
def test_an_interrupt_reaches_the_parent_and_the_next_call_works() -> None:
    process = program(HANGING, start_new_session=True)
    assert process.stdout is not None
    process.stdout.readline()
    os.killpg(process.pid, signal.SIGINT)
    output, errors = process.communicate(timeout=30)
    assert (output, errors) == ("interrupted\n1\n", "")


@LINUX
def test_the_child_ends_when_its_parent_is_killed() -> None:
    process = program(HANGING)
    assert process.stdout is not None
    child = int(process.stdout.readline())
    process.kill()
    process.communicate(timeout=30)
    wait_for_the_end_of(child)


def wait_for_the_end_of(process: int) -> None:
    deadline = time.monotonic() + 20
    while is_running(process):
        assert time.monotonic() < deadline, "the process lives on"
        time.sleep(0.01)


def is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    status = Path(f"/proc/{process}/stat").read_text()
    return status.rsplit(")", 1)[1].split()[0] != "Z"  # an orphan may stay a zombie where nobody reaps


@POSIX
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_forked_process_gets_children_of_its_own() -> None:
    script = """
        import os
        from hullquad import worker
        mine = worker.call(os.getpid, seconds=30, place="plate H1")
        if (fork := os.fork()) == 0:
            other = worker.call(os.getpid, seconds=30, place="plate H1")
            worker.stop()
            os._exit(0 if other != mine else 1)
        print(os.waitpid(fork, 0)[1], worker.call(os.getpid, seconds=30, place="plate H1") == mine)
    """
    process = program(
        script.replace("import os\n", "import os, warnings\n        warnings.simplefilter('ignore')\n", 1)
    )
    output, _ = process.communicate(timeout=30)
    assert output == "0 True\n"

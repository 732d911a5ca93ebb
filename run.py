#!/usr/bin/env python3
"""Start HullQuad, or test it, on a machine that has nothing but Python 3.11 - 3.13.

    python3 run.py [FILES]            the window
    python3 run.py mesh PLATES ...    a command of the engine (mesh, optimize, quality)
    python3 run.py test [ARGS]        the tests, on all processors; ARGS, if there are any, go to pytest instead

The first start makes .venv beside this file, with what requirements.lock pins; later ones take no time.
On Windows say `py` for `python3`. An old Python must be able to read this file, so its syntax is old, too.
"""

import contextlib
import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time

VERSIONS = ((3, 13), (3, 12), (3, 11))  # no wheels of `triangle` for 3.14
WINDOWS = os.name == "nt"
HERE = os.path.dirname(os.path.realpath(__file__))
LOCK = os.path.join(HERE, "requirements.lock")
VENV = os.path.join(HERE, ".venv")
PYTHON = os.path.join(VENV, "Scripts", "python.exe") if WINDOWS else os.path.join(VENV, "bin", "python")
STAMP = os.path.join(VENV, "stamp")
SOURCES = ("engine", "app")
ALL_TESTS = ["-n", "auto", "--maxprocesses", "4", "--dist", "loadfile"]  # a file's tests share what they prepare


def say(text):
    sys.stderr.write("run.py: " + text + "\n")
    sys.stderr.flush()


def become(command):
    """Go on as another program: its exit code is ours, and so are the signals sent to us."""
    if not WINDOWS:
        os.execv(command[0], command)
    child = subprocess.Popen(command)
    while True:
        try:
            return child.wait()
        except KeyboardInterrupt:
            pass  # the child got it, too, and decides


def other_python():
    """Path of an interpreter that will do, or None; a name on PATH may be a shim that fails, so each is run."""
    for version in VERSIONS:
        name = "%d.%d" % version
        for command in ([["py", "-" + name]] if WINDOWS else []) + [["python" + name], ["python3"]]:
            ask = command + ["-c", "import sys; print('%d.%d' % sys.version_info[:2]); print(sys.executable)"]
            try:
                with open(os.devnull, "w") as nothing:
                    answer = subprocess.check_output(ask, stderr=nothing).decode().split("\n")
            except (OSError, subprocess.CalledProcessError, UnicodeDecodeError):
                continue
            if answer[0].strip() == name:
                return answer[1].strip()
    return None


@contextlib.contextmanager
def alone():
    """Only one start at a time sets up; what it starts holds the lock as well, should it be killed itself."""
    with open(VENV + ".lock", "a+") as lock:
        waiting = False
        while not locked(lock):
            waiting = waiting or say("waiting for another start that is setting up") or True
            time.sleep(0.5)
        os.set_inheritable(lock.fileno(), True)
        yield


def locked(lock):
    try:
        if WINDOWS:
            import msvcrt

            lock.seek(0)
            msvcrt.locking(lock.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def missing_packages(arguments):
    """System packages to install before `arguments` can run, and the libraries among them by name."""
    sonames, packages = [], []
    if not sys.platform.startswith("linux"):
        return sonames, packages
    from hullquad_app import ENGINE_COMMANDS, libraries

    if arguments[:1] == ["test"] or not set(arguments[:1]) & set(ENGINE_COMMANDS + ("-h", "--help", "--version")):
        sonames = libraries.missing()
        packages = [libraries.PACKAGES[name] for name in sonames]
    if arguments[:1] == ["test"] and not shutil.which("Xvfb"):
        packages.append("xvfb")
    try:
        import ensurepip  # noqa: F401  (Debian has it in a package of its own)
    except ImportError:
        if not current():
            packages.append("python%d.%d-venv" % sys.version_info[:2])
    return sonames, packages


def install(sonames, packages):
    """Install system packages as root, or with sudo when a person agrees; otherwise say how."""
    from hullquad_app import libraries

    root = os.geteuid() == 0
    advice = libraries.advice(packages, sonames)
    if not shutil.which("apt-get") or not (root or (shutil.which("sudo") and sys.stdin.isatty())):
        sys.exit("run.py: " + advice)
    if not root:
        say("this machine lacks " + " ".join(packages))
        if input("Install them with sudo apt-get now? [Y/n] ").strip().lower() not in ("", "y", "yes"):
            sys.exit("run.py: " + advice)
    say("installing " + " ".join(packages))
    apt = ([] if root else ["sudo"]) + ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-qq"]
    apt += ["-o", "DPkg::Lock::Timeout=300"]
    log = subprocess.run(apt + ["update"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, close_fds=False)
    words = ["install", "-y", "--no-install-recommends"] + packages
    done = subprocess.run(apt + words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, close_fds=False)
    if done.returncode:
        sys.stderr.write((log.stdout + done.stdout).decode(errors="replace"))
        sys.exit("run.py: apt-get failed, see above; " + advice)


def key():
    """What .venv depends on; the sources are only pointed to, so changing them changes nothing here."""
    with open(LOCK, "rb") as lock:
        parts = [lock.read(), b"%d.%d" % sys.version_info[:2], os.fsencode(HERE), " ".join(SOURCES).encode()]
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def current():
    """Is .venv complete and made for this lock, Python and folder?"""
    try:
        with open(STAMP) as stamp:
            return stamp.read() == key() and os.path.exists(PYTHON)
    except OSError:
        return False


def make_environment():
    """Make .venv from nothing; the stamp comes last, so an interrupted one is made again."""
    say("setting up .venv, once (about 500 MB to fetch, 1.3 GB on the disk)")
    if os.path.exists(STAMP):
        os.remove(STAMP)
    base = getattr(sys, "_base_executable", sys.executable)  # not the .venv that is about to be cleared
    pip = [PYTHON, "-m", "pip", "install", "--disable-pip-version-check", "--require-hashes", "--no-deps"]
    pip += ["--only-binary=:all:", "-r", LOCK] + ([] if sys.stderr.isatty() else ["--quiet"])
    if subprocess.call([base, "-m", "venv", "--clear", VENV], close_fds=False):
        sys.exit("run.py: .venv cannot be made, see above; is the disk full, or a program running from it?")
    if subprocess.call(pip, close_fds=False):
        sys.exit(
            "run.py: the packages could not be installed, see above. Without a network connection the first start\n"
            "cannot work (behind a company's proxy or mirror: pip.conf). Then start again: it begins afresh."
        )
    point_to_sources()


def point_to_sources():
    ask = [PYTHON, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    site = os.fsdecode(subprocess.check_output(ask)).strip()
    with open(os.path.join(site, "hullquad.pth"), "w") as pointer:  # relative: no trouble with the encoding of names
        pointer.writelines(os.path.relpath(os.path.join(HERE, source), site) + "\n" for source in SOURCES)
    with open(STAMP, "w") as stamp:
        stamp.write(key())


def prepare(arguments):
    if current() and not any(missing_packages(arguments)):
        return
    with alone():
        sonames, packages = missing_packages(arguments)
        if packages:
            install(sonames, packages)
        if not current():
            make_environment()


def main(arguments):
    if sys.version_info[:2] not in VERSIONS:
        python = other_python()
        if python:
            return become([python, os.path.realpath(__file__)] + arguments)
        say("HullQuad needs Python 3.11, 3.12 or 3.13, this is %s. Install one (Debian 12:" % sys.version.split()[0])
        say("apt-get install python3 python3-venv; elsewhere: python.org/downloads), then start again.")
        return 1
    sys.path.insert(0, os.path.join(HERE, "app"))
    from hullquad_app import ENGINE_COMMANDS

    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # end pip with us
    prepare(arguments)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if arguments[:1] == ["test"]:
        os.chdir(HERE)
        command = ["pytest"] + (arguments[1:] or ALL_TESTS)
    else:
        command = ["hullquad" if arguments[:1] and arguments[0] in ENGINE_COMMANDS else "hullquad_app"] + arguments
    return become([PYTHON, "-P", "-m"] + command)  # -P: modules of the current folder stay out


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        say("interrupted; the next start begins afresh")
        sys.exit(130)
    except OSError as problem:
        sys.exit("run.py: %s" % problem)

"""The entry script ./furrow, in a copy of the project where every tool it calls is a stand-in that writes down how it was called."""

import os
import shutil
import subprocess
import time

import pytest

from tests.harness.program import ROOT

PROGRAM = '#!/bin/sh\necho "program in $PWD: $*"\nexit 7\n'


class Project:
    def __init__(self, folder):
        self.folder = folder
        self.tools = folder / "tools"
        self.build = folder / "build/release"
        self.calls = folder / "calls"
        self.tools.mkdir(parents=True)
        self.build.mkdir(parents=True)
        (folder / "solver").mkdir()
        (folder / "solver/a.cpp").write_text("\n")
        (folder / "packages.txt").write_text("cmake  # builds\nlibfoo-dev  # is not there\n")
        shutil.copy(ROOT / "furrow", folder / "furrow")
        self.program(self.build / "furrow-program", PROGRAM)
        self.tool("dpkg-query", "echo 'cmake installed'; echo 'libfoo-dev installed'")
        self.tool("cmake", f"mkdir -p build/release; touch build/release/build.ninja; cp {self.build}/furrow-program {self.build}/again")
        self.tool("apt-get", "true")
        self.tool("id", "echo 1000")
        self.tool("sudo", "exit 1")
        self.calls.write_text("")
        self.built()

    @staticmethod
    def program(path, text):
        path.write_text(text)
        path.chmod(0o755)

    def tool(self, name, body):
        self.program(self.tools / name, f'#!/bin/sh\necho "{name} $*" >> {self.calls}\n{body}\n')

    def built(self):
        """The build is newer than every source."""
        stamp = self.build / "built-furrow-program"
        stamp.touch()
        later = time.time() + 10
        os.utime(stamp, (later, later))
        (self.build / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={self.folder}\n")
        (self.build / "build.ninja").touch()

    def change_a_source(self):
        later = time.time() + 20
        os.utime(self.folder / "solver/a.cpp", (later, later))

    def run(self, *arguments, script=None, cwd="/"):
        environment = {k: v for k, v in os.environ.items() if k != "CI"} | {"PATH": f"{self.tools}:{os.environ['PATH']}"}
        return subprocess.run([script or self.folder / "furrow", *arguments], capture_output=True, text=True, cwd=cwd, env=environment,
                              timeout=60)

    def called(self, name):
        return [line for line in self.calls.read_text().splitlines() if line.startswith(name + " ")]


@pytest.fixture
def project(tmp_path):
    return Project(tmp_path.resolve() / "project")


def test_it_hands_over_arguments_folder_and_exit_code(project, tmp_path):
    ended = project.run("run", "a b", "--quiet", cwd=tmp_path)
    assert ended.stdout == f"program in {tmp_path}: run a b --quiet\n"
    assert ended.returncode == 7
    assert project.called("cmake") == []


def test_it_works_through_a_symbolic_link(project, tmp_path):
    link = tmp_path / "link"
    link.symlink_to(project.folder / "furrow")
    assert project.run("list", script=link).stdout == "program in /: list\n"


def test_it_builds_when_a_source_is_newer_and_only_then(project):
    project.change_a_source()
    assert project.run("list").returncode == 7
    assert project.called("cmake") == ["cmake --build --preset release --target furrow-program"]
    assert project.run("list").stdout == "program in /: list\n"


def test_it_configures_when_the_build_was_made_elsewhere(project):
    (project.build / "CMakeCache.txt").write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n")
    project.change_a_source()
    project.run("list")
    assert project.called("cmake")[0] == "cmake --preset release"


def test_a_build_that_fails_ends_it(project):
    project.tool("cmake", "exit 1")
    project.change_a_source()
    ended = project.run("list")
    assert ended.returncode == 3
    assert "the build failed" in ended.stderr
    assert ended.stdout == ""


def test_a_missing_package_without_root_is_one_command_to_run(project):
    project.tool("dpkg-query", "echo 'cmake installed'; echo 'libfoo-dev not-installed'; exit 1")
    ended = project.run("list")
    assert ended.returncode == 2
    assert ended.stderr.splitlines()[-1] == "sudo sh -c 'apt-get update && apt-get install -y --no-install-recommends libfoo-dev'"
    assert project.called("apt-get") == []


@pytest.mark.parametrize("root", [True, False], ids=["root", "passwordless sudo"])
def test_a_missing_package_is_installed_where_that_is_allowed(project, root):
    project.tool("dpkg-query", "echo 'cmake installed'; exit 1")
    if root:
        project.tool("id", "echo 0")
    else:
        project.tool("sudo", '[ "$1" = -n ] && exit 0; exec "$@"')
    ended = project.run("list")
    assert ended.stdout == "program in /: list\n"
    assert project.called("apt-get") == ["apt-get update -q", "apt-get install -y --no-install-recommends libfoo-dev"]
    assert bool(project.called("sudo")) != root


def test_an_installation_that_fails_ends_it(project):
    project.tool("dpkg-query", "exit 1")
    project.tool("id", "echo 0")
    project.tool("apt-get", "exit 100")
    ended = project.run("list")
    assert ended.returncode == 2
    assert "apt-get could not install the packages" in ended.stderr

"""Every command says what it is for, with an example; scripts/setup says what it may not install."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

DIPPER = os.environ["DIPPER"]
SOURCE = pathlib.Path(__file__).resolve().parents[3]


def help_of(*words):
    return subprocess.run([DIPPER, *words, "--help"], capture_output=True, text=True, check=True).stdout


def listed():
    return re.findall(r"^  (\w+) ", help_of().split("Subcommands:")[1].split("\n\n")[0], re.M)


class Help(unittest.TestCase):
    def test_every_command_has_an_example_of_itself(self):
        names = listed()
        self.assertLess({"run", "check", "preview", "clean"}, set(names))
        for name in names:
            words = (name, "pile-angle") if name == "calibrate" else (name,)
            example = "dipper completion" if name == "completion" else "dipper " + " ".join(words)
            with self.subTest(name):
                before, _, after = help_of(*words).lower().rpartition("example")
                self.assertIn(name, before)
                self.assertIn(example, " ".join(after.split()))

    def test_commands_are_listed_in_the_order_of_work(self):
        order = ("import", "survey", "motion", "check", "preview", "calibrate", "run", "report", "study", "gap",
                 "clean", "help")
        self.assertEqual([name for name in listed() if name in order], list(order))
        self.assertNotIn("page", listed(), "other programs call it")

    def test_help_is_a_command(self):
        for words in ((), ("run",), ("gap",), ("calibrate", "pile-angle")):
            with self.subTest(words):
                asked = subprocess.run([DIPPER, "help", *words], capture_output=True, text=True, check=True)
                self.assertEqual(asked.stdout, help_of(*words))

    def test_help_of_no_command_is_an_error(self):
        for word, said in (("rnu", "rnu is not a command; did you mean run?"), ("xyzzy", "dipper help lists them")):
            for words in (("help", word), (word, "case")):
                asked = subprocess.run([DIPPER, *words], capture_output=True, text=True)
                self.assertEqual((asked.returncode, asked.stdout), (2, ""))
                self.assertIn(said, asked.stderr)

    def test_the_options_of_a_python_program_are_those_of_its_command(self):
        options = re.compile(r"--[\w-]+")
        path = os.pathsep.join(str(SOURCE / "analysis" / name) for name in ("gap", "logs", "runs", "study", "survey"))
        for name in ("gap", "study", "import", "survey"):
            with self.subTest(name):
                own = subprocess.run(["/usr/bin/python3", "-B", "-m", f"dipper_{name}", "--help"], check=True,
                                     capture_output=True, text=True, env={**os.environ, "PYTHONPATH": path}).stdout
                listed_options = help_of(name).split("Options:")[1]
                self.assertEqual(set(options.findall(own.split("options:")[1])),
                                 set(re.findall(r"^  (?:-h,)?(--[\w-]+)", listed_options, re.M)))

    def test_completion_and_the_manual_page_have_every_option_of_every_command(self):
        def said(*words):
            return subprocess.run([DIPPER, "completion", *words], capture_output=True, text=True, check=True).stdout

        commands = [(name,) for name in listed() if name not in ("help", "calibrate")]
        commands += [("calibrate", what) for what in ("pile-angle", "bulk-density")]
        manual = re.split(r"^\.SS (.*)$", said("--man").replace("\\-", "-"), flags=re.M)
        sections = dict(zip(manual[1::2], manual[2::2]))
        tried = 0
        for words in commands:
            options = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_of(*words), re.M)) - {"--help"}
            section = sections["dipper " + " ".join(words)]
            typed = " ".join(("dipper", *words, "--"))
            offered = subprocess.run(["bash"], input=f"{said()}\nCOMP_WORDS=({typed}); COMP_CWORD={len(words) + 1}\n"
                                     "_dipper; echo ${COMPREPLY[@]}", capture_output=True, text=True, check=True).stdout
            with self.subTest(words):
                self.assertEqual(set(re.findall(r"^\.B (--[\w-]+)", section, re.M)) - {"--help"}, options)
                self.assertEqual(set(offered.split()) - {"--help"}, options)
            tried += len(options)
        self.assertGreater(tried, 40)

    def test_set_up_without_rights_lists_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("dpkg-query", "exit 1"), ("id", "echo 1000"), ("sudo", "exit 1")):
                program = pathlib.Path(folder, name)
                program.write_text(f"#!/bin/sh\n{text}\n")
                program.chmod(0o755)
            env = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
            done = subprocess.run([SOURCE / "scripts" / "setup", "packages"], capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, env=env)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("an administrator does it with: apt-get install g++ cmake", done.stderr)


if __name__ == "__main__":
    unittest.main()

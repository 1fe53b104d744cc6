"""scripts/check_types, on small trees with types of one name."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_types"


class CheckTypes(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="dipper-types-"))
        self.addCleanup(shutil.rmtree, self.root)
        subprocess.run(["git", "init", "-q", self.root], check=True)

    def check(self, one, other, *wrong):
        (self.root / "one.cpp").write_text(one)
        (self.root / "other.hpp").write_text(other)
        done = subprocess.run([PROGRAM, self.root], capture_output=True, text=True)
        self.assertEqual(done.stdout.splitlines()[:-1], list(wrong), done.stderr)
        self.assertEqual(done.returncode, 1 if wrong else 0)

    def test_passes_types_of_their_own_names(self):
        self.check("namespace a { struct A {}; class B; enum class C { x }; }",
                   "namespace b { struct A {}; class B {}; }\nnamespace a { struct D { struct A {}; }; }")

    def test_two_types_of_one_name(self):
        self.check("namespace a::b {\nstruct A { int x; };\n}",
                   "namespace a {\nnamespace b {\nclass A final : C<int> {};\n}\n}",
                   "one.cpp:2: a::b::A is also defined at other.hpp:3")

    def test_an_enum_and_a_template(self):
        self.check("enum class A : int { x };", "template <class T, int n>\nclass [[nodiscard]] A {};",
                   "one.cpp:1: A is also defined at other.hpp:1")

    def test_a_type_in_a_type(self):
        self.check("struct A { A(int x = 1) { f({x}); } struct B {}; };", "struct A::B {};",
                   "one.cpp:1: A::B is also defined at other.hpp:1")

    def test_what_is_a_file_s_own_may_have_any_name(self):
        own = "namespace { struct A {}; }\nvoid %s() { struct B {}; g([] { struct C {}; }); }\nint x = 1'000;"
        self.check(own % "f", own % "h")

    def test_specialisations_differ(self):
        self.check("template <> struct A<int> {};", "template <class T> struct A {};\ntemplate <> struct A<double> {};")

    def test_words_in_comments_and_strings_are_none(self):
        self.check('struct A {};  // struct A {};\nauto x = "struct A {";\nauto y = R"(struct A {)";',
                   "/* struct A {}; */\n#define A struct A {\nstruct A* f() { return 0; }\nstruct B {};")

    def test_a_type_that_depends_on_the_preprocessor(self):
        self.check("#if X\n#endif\nstruct A {\n#ifdef X\n  int x;\n#endif\n};", "",
                   "one.cpp:4: #if in a type, which may differ between files then")


if __name__ == "__main__":
    unittest.main()

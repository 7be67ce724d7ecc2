"""Shows docs/api/api_reference.py small headers, right ones and wrong ones."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "api"))
from api_reference import Library  # noqa: E402

HEAD = """/* one.h - things.
 *
 *     example(1);
 *
 * Errors: functions that can fail return a status.
 *
 * Ownership: what is passed stays the caller's. Threads: any.
 */
#ifndef ONE_H
#define ONE_H
"""
GOOD = """
enum one_status { ONE_OK, ONE_NO_MEMORY };
struct one { int a; /* a member; */ };

/* Makes one. Errors: NO_MEMORY. Owns: the caller destroys *out. */
enum one_status one_create(struct one **out);
void one_destroy(struct one *o); /* NULL is fine */

/* How many, and how large. Threads: the one that made it. */
int one_count(const struct one *o);
static inline double one_size(const struct one *o)
{
    return o->a ? 1 : 2;
}

/* Its name, never NULL, valid for ever. */
const char *one_name(void);
/* Whether it is good. */
bool one_good(const struct one *o);
#endif
"""


class Reference(unittest.TestCase):
    def library(self, text, head=HEAD, **more):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, content in {"one.h": head + text, **{k + ".h": v for k, v in more.items()}}.items():
                (root / name).write_text(content)
            return Library(root, "Things", ["one.h"] + [k + ".h" for k in more])

    def wrong(self, text, part, head=HEAD):
        found = self.library(text, head).check()
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_good(self):
        library = self.library(GOOD)
        self.assertEqual(library.check(), [])
        self.assertEqual(sorted(library.functions), ["one_count", "one_create", "one_destroy", "one_good", "one_name", "one_size"])

    def test_told(self):
        library = self.library(GOOD)
        self.assertEqual(library.told(library.functions["one_create"]), ("NO_MEMORY.", "the caller destroys *out.", "any."))
        self.assertEqual(library.told(library.functions["one_size"]),
                         ("none", "what is passed stays the caller's.", "the one that made it."))
        text = library.reference()
        for part in ("enum one_status one_create(struct one **out);", "    example(1);", "| none | what is passed", "ONE_NO_MEMORY"):
            self.assertIn(part, text)

    def test_head_of_another(self):
        two = "/* two.h - more. Errors, ownership and threads: as one.h says. */\n/* Two. */\nvoid two(void);\n"
        library = self.library(GOOD, two=two)
        self.assertEqual(library.check(), [])
        self.assertEqual(library.told(library.functions["two"])[2], "any.")
        self.assertEqual(len(self.library(GOOD, two=two.replace("one.h", "six.h")).check()), 3)

    def test_wrong(self):
        self.wrong("/* Runs. */\nenum one_status one_run(void);\n", "which errors")
        self.wrong("/* Runs. Errors: as one_go(). */\nenum one_status one_run(void);\n", "in no public header")
        self.wrong("/* Good. */\nbool one_good(void);\n", "when it is false")
        self.wrong("/* Makes one; NULL: no memory. */\nstruct one *one_new(void);\n", "who owns it")
        self.wrong("/* Makes one. Errors: X. */\nenum one_status one_new(struct one **out);\n", "who owns it")
        self.wrong("/* Its name, valid for ever. */\nconst char *one_name(void);\n", "when it is NULL")
        self.wrong("/* Its name or NULL. */\nconst char *one_name(void);\n", "how long it is valid")
        self.wrong("\nvoid one_run(void);\n", "has no comment")

    def test_heads(self):
        self.wrong("/* Runs. */\nvoid one_run(void);\n", "`Threads:`", HEAD.replace(" Threads: any.", ""))
        self.wrong("/* Runs. */\nvoid one_run(void);\n", "`Ownership:`", HEAD.replace("Ownership:", "Property:"))


if __name__ == "__main__":
    unittest.main()

/* test_reader_edit.c - a hand that edits in the reader's window: letters, deleting, words that
 * an input method gives, undo, replacing, saving, the question at the end, files that others
 * change meanwhile, and edits that a killed program has left. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "reader_played.h"
#include "xvfb.h"

static const char text[] =
    "# One\n\nA word and *another* one[^a].\n\n[^a]: What the note says.\n\n"
    "Second paragraph, of more\nthan one line.\n\n- first\n- second\n\n"
    "The last heron.\n";

static void document_write(void)
{
    char command[400];
    snprintf(command, sizeof command, "rm -f %s.*", played_path("one.md"));
    assert_int_equal(system(command), 0);
    played_write("one.md", text);
    chmod(played_path("one.md"), 0640);
}

/* What is in a file. */
static const char *is_now(const char *name)
{
    static char bytes[4000];
    FILE *file = fopen(played_path(name), "r");
    if (!file)
        return "";
    bytes[fread(bytes, 1, sizeof bytes - 1, file)] = '\0';
    fclose(file);
    return bytes;
}

/* The text with one part of it otherwise. */
static const char *with(const char *from, const char *to)
{
    static char bytes[4000];
    const char *at = strstr(text, from);
    assert_non_null(at);
    snprintf(bytes, sizeof bytes, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    return bytes;
}

static void letters_are_typed_and_saved(void **state)
{
    char lines[3000];
    struct stat status;
    (void)state;
    document_write();
    snprintf(lines, sizeof lines,
             "0.2 select Second\n0.3 action highlight\n0.4 action edit\n0.5 select heron\n"
             "0.6 strike Right\n0.7 type s *stand*\n0.8 tell %s\n"
             "0.9 action save\n1 tell %s\n",
             played_path("typed"), played_path("saved"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("typed", "editing"), "1");
    assert_string_equal(played_told("typed", "unsaved"), "1");
    assert_string_equal(played_told("typed", "remarks"), "1");
    assert_string_equal(played_told("saved", "unsaved"), "0");
    assert_string_equal(is_now("one.md"), with("heron", "herons \\*stand\\*"));
    assert_int_equal(stat(played_path("one.md"), &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
}

static void all_is_undone(void **state)
{
    char lines[3000];
    (void)state;
    document_write();
    snprintf(lines, sizeof lines,
             "0.2 action edit\n0.3 select another\n0.4 type a new\n0.5 select first\n"
             "0.6 strike Right\n0.7 strike Delete\n0.8 strike Control+End\n0.9 strike Return\n"
             "1 type More\n1.1 strike Shift+Home\n1.2 strike Delete\n1.3 tell %s\n"
             "1.4 action undo\n1.5 action undo\n1.6 action undo\n1.7 action undo\n"
             "1.8 action undo\n1.9 tell %s\n",
             played_path("edited"), played_path("undone"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("edited", "unsaved"), "1");
    assert_string_equal(played_told("undone", "unsaved"), "0");
    assert_string_equal(is_now("one.md"), text);
}

/* What an input method has not given yet is seen, and is no text. */
static void preedit_is_seen(void **state)
{
    char lines[2000];
    (void)state;
    document_write();
    snprintf(
        lines, sizeof lines,
        "0.2 action edit\n0.3 select heron\n0.4 strike Left\n0.5 preedit \xe6\xb0\xb4\n"
        "0.6 tell %s\n0.6 picture %s\n0.7 preedit\n0.8 type \xe6\xb0\xb4\n0.9 action save\n",
        played_path("before"), played_path("preedit.png"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("before", "preedit"), "\xe6\xb0\xb4");
    assert_string_equal(played_told("before", "unsaved"), "0");
    assert_string_equal(is_now("one.md"), with("heron", "\xe6\xb0\xb4heron"));
}

static void hits_are_replaced(void **state)
{
    (void)state;
    document_write();
    played_run("0.2 action edit\n0.3 search one\n0.5 replace two\n0.7 action save\n",
               played_path("one.md"));
    played_well();
    char now[sizeof text];
    memcpy(now, text, sizeof text);
    for (char *at = now; (at = strcasestr(at, "one"));)
        memcpy(at, "two", 3);
    assert_string_equal(is_now("one.md"), now);
}

/* Closing asks; what is given up is gone, what is saved is there. */
static void closing_asks(void **state)
{
    (void)state;
    document_write();
    played_run("0.2 action edit\n0.3 type x\n0.5 close\n0.9 answer discard\n",
               played_path("one.md"));
    played_well();
    assert_string_equal(is_now("one.md"), text);
    assert_int_equal(access(played_path("one.md.edits"), F_OK), -1);
    played_run("0.2 action edit\n0.3 type x\n0.5 close\n0.9 answer save\n",
               played_path("one.md"));
    played_well();
    assert_string_equal(is_now("one.md"), with("# One", "# xOne"));
}

/* What was not saved when a program was killed is there again. */
static void killed_loses_nothing(void **state)
{
    char lines[2000], command[400];
    (void)state;
    document_write();
    unlink(played_path("kept"));
    snprintf(lines, sizeof lines,
             "0.2 action edit\n0.3 select heron\n0.4 type crane\n0.5 tell %s\n2.5 tell %s\n"
             "9 tell %s\n",
             played_path("typed"), played_path("kept"), played_path("never"));
    snprintf(
        command, sizeof command,
        "(while [ ! -s %s ]; do sleep 0.05; done; kill -9 $(sed -n 's/^process //p' %s)) &",
        played_path("kept"), played_path("kept"));
    assert_int_equal(system(command), 0);
    played_run(lines, played_path("one.md"));
    assert_string_equal(is_now("one.md"), text);
    assert_int_equal(access(played_path("one.md.edits"), F_OK), 0);
    snprintf(lines, sizeof lines, "0.3 tell %s\n0.4 action save\n", played_path("again"));
    played_run(lines, played_path("one.md"));
    assert_int_equal(played.status, 0);
    assert_non_null(strstr(played.errors, "here again"));
    assert_string_equal(played_told("again", "unsaved"), "1");
    assert_string_equal(is_now("one.md"), with("heron", "crane"));
    assert_int_equal(access(played_path("one.md.edits"), F_OK), -1);
}

/* Another program changes another place: both are there. */
static void others_edits_are_joined(void **state)
{
    char lines[2000], command[600];
    (void)state;
    document_write();
    unlink(played_path("edited"));
    snprintf(
        lines, sizeof lines,
        "0.2 action edit\n0.3 select heron\n0.4 type crane\n0.5 tell %s\n2.5 action save\n",
        played_path("edited"));
    snprintf(command, sizeof command,
             "(while [ ! -s %s ]; do sleep 0.05; done; sed -i 's/A word/Some words/' %s) &",
             played_path("edited"), played_path("one.md"));
    assert_int_equal(system(command), 0);
    played_run(lines, played_path("one.md"));
    played_well();
    assert_non_null(strstr(is_now("one.md"), "Some words and"));
    assert_non_null(strstr(is_now("one.md"), "The last crane."));
}

/* And the same place: both are kept, in two files. */
static void both_texts_are_kept(void **state)
{
    char lines[2000], command[600];
    (void)state;
    document_write();
    unlink(played_path("edited"));
    snprintf(lines, sizeof lines,
             "0.2 action edit\n0.3 select heron\n0.4 type crane\n0.5 tell %s\n2.5 tell %s\n",
             played_path("edited"), played_path("after"));
    snprintf(command, sizeof command,
             "(while [ ! -s %s ]; do sleep 0.05; done; sed -i 's/heron/stork/' %s) &",
             played_path("edited"), played_path("one.md"));
    assert_int_equal(system(command), 0);
    played_run(lines, played_path("one.md"));
    assert_int_equal(played.status, 0);
    assert_non_null(strstr(played.errors, "the edited text is "));
    assert_string_equal(played_told("after", "unsaved"), "0");
    assert_string_equal(is_now("one.md"), with("heron", "stork"));
    assert_string_equal(is_now("one.md.edited.md"), with("heron", "crane"));
}

/* Where the edited text cannot be put beside, the other program's is not replaced. */
static void nothing_replaces_what_others_wrote(void **state)
{
    enum { BESIDE_MOST = 1000 };
    char lines[2000], command[600], path[600];
    (void)state;
    document_write();
    unlink(played_path("edited"));
    for (int i = 1; i < BESIDE_MOST; i++) { /* all names are taken */
        snprintf(path, sizeof path, i > 1 ? "%s.edited-%d.md" : "%s.edited.md",
                 played_path("one.md"), i);
        fclose(fopen(path, "w"));
    }
    snprintf(lines, sizeof lines,
             "0.2 action edit\n0.3 select heron\n0.4 type crane\n0.5 tell %s\n2.5 action save\n"
             "2.7 tell %s\n2.8 close\n3.2 answer discard\n",
             played_path("edited"), played_path("after"));
    snprintf(command, sizeof command,
             "(while [ ! -s %s ]; do sleep 0.05; done; sed -i 's/heron/stork/' %s) &",
             played_path("edited"), played_path("one.md"));
    assert_int_equal(system(command), 0);
    played_run(lines, played_path("one.md"));
    assert_non_null(strstr(played.errors, "there are too many such files"));
    assert_non_null(strstr(played.errors, "another program has written it"));
    assert_string_equal(played_told("after", "unsaved"), "1");
    assert_string_equal(is_now("one.md"), with("heron", "stork"));
    for (int i = 1; i < BESIDE_MOST; i++) {
        snprintf(path, sizeof path, i > 1 ? "%s.edited-%d.md" : "%s.edited.md",
                 played_path("one.md"), i);
        unlink(path);
    }
}

static void read_only_says_so(void **state)
{
    char lines[1000];
    (void)state;
    if (geteuid() == 0) { /* may write anything: the manual alone says so */
        const char *const arguments[] = {getenv("LUTETIA"), "read", "--play",
                                         played_path("hand.events")};
        played_write("hand.events", "0.3 action edit\n0.6 close\n");
        memset(&played, 0, sizeof played);
        memcpy(played.arguments, arguments, sizeof arguments);
        played.variables[0] = "GTK_A11Y=none";
        child_run(&played);
        played_says(0, "The manual is not edited");
        return;
    }
    document_write();
    chmod(played_path("one.md"), 0400);
    snprintf(lines, sizeof lines, "0.2 action edit\n0.4 tell %s\n", played_path("only"));
    played_run(lines, played_path("one.md"));
    played_says(0, "can only be read");
    assert_string_equal(played_told("only", "editing"), "0");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_typed_and_saved),
        cmocka_unit_test(all_is_undone),
        cmocka_unit_test(preedit_is_seen),
        cmocka_unit_test(hits_are_replaced),
        cmocka_unit_test(closing_asks),
        cmocka_unit_test(killed_loses_nothing),
        cmocka_unit_test(others_edits_are_joined),
        cmocka_unit_test(both_texts_are_kept),
        cmocka_unit_test(nothing_replaces_what_others_wrote),
        cmocka_unit_test(read_only_says_so),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, played_begin, played_end);
}

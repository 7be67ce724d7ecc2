/* test_reader_access.c - the reader's window as a screen reader, a keyboard and a mouse find
 * it: the text that is seen is heard, every control has a name, keys and the wheel scroll,
 * words are typed into a note, and a mouse draws. By AT-SPI and XTEST, on an Xvfb with a bus of
 * its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <X11/keysym.h>
#include <atspi/atspi.h>
#include <reader_remarks.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "accessible.h"
#include "clock.h"
#include "xtest.h"

enum { WAIT_S = 60 };
static pid_t reader;
static Window window;
static AtspiAccessible *frame;
static char folder[] = "/tmp/lutetia-reader-XXXXXX", document[64];

/* ---- the tree ---- */

/* All names, texts and descriptions, one a line. */
static void text_collect(AtspiAccessible *a, void *context)
{
    GString *all = context;
    char *name = atspi_accessible_get_name(a, NULL);
    AtspiText *text = atspi_accessible_get_text_iface(a);
    const int count = text ? atspi_text_get_character_count(text, NULL) : 0;
    char *said = count > 0 ? atspi_text_get_text(text, 0, count, NULL) : NULL;
    char *more = atspi_accessible_get_description(a, NULL);
    g_string_append_printf(all, "%s\n%s\n%s\n", name ? name : "", said ? said : "",
                           more ? more : "");
    g_free(more);
    g_free(said);
    g_free(name);
    g_clear_object(&text);
}

/* Waits until all that is heard has the text, or has it no more. */
static bool heard(const char *text, bool there)
{
    const double until_s = clock_now_s() + WAIT_S;
    while (clock_now_s() < until_s) {
        GString *all = g_string_new(NULL);
        atspi_accessible_clear_cache(frame);
        accessible_walk(frame, text_collect, all);
        const bool found = strstr(all->str, text) != NULL;
        g_string_free(all, TRUE);
        if (found == there)
            return true;
        usleep(100000);
    }
    return false;
}

struct names {
    int named, nameless;
};

static void name_check(AtspiAccessible *a, void *context)
{
    struct names *names = context;
    const AtspiRole role = atspi_accessible_get_role(a, NULL);
    const bool control = role == ATSPI_ROLE_PUSH_BUTTON || role == ATSPI_ROLE_TOGGLE_BUTTON ||
                         role == ATSPI_ROLE_SCROLL_BAR || role == ATSPI_ROLE_LIST ||
                         role == ATSPI_ROLE_LIST_ITEM || role == ATSPI_ROLE_TEXT ||
                         role == ATSPI_ROLE_ENTRY;
    char *name = atspi_accessible_get_name(a, NULL);
    if (control && name && name[0])
        names->named++;
    else if (control) {
        char *text = atspi_accessible_get_role_name(a, NULL);
        print_message("a %s without a name\n", text);
        g_free(text);
        names->nameless++;
    }
    g_free(name);
}

/* ---- the window ---- */

static int start(void **state)
{
    (void)state;
    reader = fork();
    if (reader == 0) {
        execl(getenv("LUTETIA"), "lutetia", "read", document, "--theme", "light", NULL);
        _exit(127);
    }
    window = screen_window("Reader", WAIT_S);
    if (!window)
        return -1;
    XSetInputFocus(screen_display(), window, RevertToParent, CurrentTime);
    XSync(screen_display(), False);
    frame = accessible_frame_wait(WAIT_S);
    return frame ? 0 : -1;
}

static int end(void **state)
{
    int status;
    (void)state;
    kill(reader, SIGKILL); /* what was kept is kept */
    waitpid(reader, &status, 0);
    g_clear_object(&frame);
    return 0;
}

static void control_type(KeySym key)
{
    xtest_key(XK_Control_L, true);
    xtest_type(key);
    xtest_key(XK_Control_L, false);
}

/* ---- what is tried ---- */

static void text_is_heard(void **state)
{
    (void)state;
    struct names names = {0};
    assert_true(heard("The reeds of paragraph 0", true));
    assert_true(heard("What the note says", false));
    xtest_type(XK_F9);
    assert_true(heard("Chapter 40", true)); /* in the contents */
    accessible_walk(frame, name_check, &names);
    assert_int_equal(names.nameless, 0);
    assert_true(names.named > 12);
}

static void keys_and_wheel_scroll(void **state)
{
    (void)state;
    xtest_type(XK_End);
    assert_true(heard("The reeds of paragraph 59", true));
    assert_true(heard("The reeds of paragraph 0", false));
    xtest_type(XK_Home);
    assert_true(heard("The reeds of paragraph 0", true));
    xtest_move(window, 600, 400);
    for (int i = 0; i < 12; i++) {
        xtest_button(5, true);
        xtest_button(5, false);
    }
    assert_true(heard("The reeds of paragraph 0", false));
    xtest_type(XK_Home);
    assert_true(heard("The reeds of paragraph 0", true));
    xtest_type(XK_Tab);
    xtest_type(XK_Return);
    assert_true(heard("What the note says", true));
}

/* The number of the control of that name. */
struct number {
    const char *name;
    double value;
};

static void number_find(AtspiAccessible *a, void *context)
{
    struct number *number = context;
    char *name = atspi_accessible_get_name(a, NULL);
    AtspiValue *value =
        name && strcmp(name, number->name) == 0 ? atspi_accessible_get_value_iface(a) : NULL;
    if (value)
        number->value = atspi_value_get_current_value(value, NULL);
    g_clear_object(&value);
    g_free(name);
}

struct called {
    const char *name;
    int count;
};

static void called_count(AtspiAccessible *a, void *context)
{
    struct called *called = context;
    char *name = atspi_accessible_get_name(a, NULL);
    called->count += name && strcmp(name, called->name) == 0;
    g_free(name);
}

/* The button of each demonstration has a name of its own: its number in the document, and the
 * heading that it stands under. */
static void demonstrations_have_names(void **state)
{
    static const char *const names[] = {"Run demonstration 1, Chapter 59",
                                        "Run demonstration 2, Last",
                                        "Run demonstration 3, Last"};
    (void)state;
    xtest_type(XK_End);
    for (int i = 0; i < 3; i++) {
        struct called called = {names[i], 0};
        assert_true(heard(names[i], true));
        accessible_walk(frame, called_count, &called);
        assert_int_equal(called.count, 1);
    }
}

/* A demonstration is run by keys, and so are its controls, which have names and values; from
 * the last of them Tab comes back to the page. */
static void controls_are_reached(void **state)
{
    (void)state;
    struct number speed = {"Speed, as a number", 0};
    struct names names = {0};
    xtest_type(XK_End);
    xtest_type(XK_Tab);
    assert_true(heard("Run demonstration 1, Chapter 59", true));
    xtest_type(XK_Return);
    assert_true(heard("speed <1.0625>", true));
    assert_true(heard("Speed, as a number", true));
    accessible_walk(frame, number_find, &speed);
    assert_true(speed.value == 1.0625);
    accessible_walk(frame, name_check, &names);
    assert_int_equal(names.nameless, 0);
    assert_true(heard("\n1.0625\n", true)); /* all of its decimals are shown */
    xtest_type(XK_Tab);                     /* to the slider */
    xtest_type(XK_Tab);                     /* to the number, and on: it stays what it is */
    xtest_type(XK_Tab);
    assert_true(heard("\n1.0625\n", true));
    assert_true(heard("speed <1.0625>", true));
    xtest_key(XK_Shift_L, true);
    xtest_type(XK_Tab);
    xtest_type(XK_Tab);
    xtest_key(XK_Shift_L, false);
    xtest_type(XK_Home);
    assert_true(heard("speed <0>", true));
    xtest_type(XK_Tab); /* to the number */
    control_type(XK_a);
    xtest_type(XK_3);
    xtest_type(XK_Return);
    assert_true(heard("speed <3>", true));
    xtest_type(XK_Tab); /* to what is usual */
    xtest_type(XK_space);
    assert_true(heard("speed <1.0625>", true));
    xtest_type(XK_Tab); /* to the page again */
    xtest_type(XK_Home);
    assert_true(heard("The reeds of paragraph 0", true));
}

/* A mouse draws, keys type into a note; both are in the list. */
/* What keys act on: strokes that are chosen, and lines of the grid. */
static void choices_are_heard(void)
{
    xtest_type(XK_Escape);
    xtest_type(XK_m);
    assert_true(heard("No ink is chosen, of 1 strokes.", true));
    xtest_type(XK_Tab);
    assert_true(heard("Ink is chosen: 1 of 1 strokes, at ", true));
    xtest_type(XK_Escape);
    xtest_type(XK_Escape);
    assert_true(heard("nk is chosen", false));
    xtest_type(XK_F8);
    assert_true(heard("The grid has ", true));
    xtest_type(XK_Tab);
    assert_true(heard("Line 1 of ", true));
    xtest_type(XK_Escape);
    assert_true(heard("Line 1 of ", false));
}

static void hand_leaves_notes(void **state)
{
    (void)state;
    xtest_type(XK_d);
    xtest_move(window, 500, 300);
    usleep(200000);
    xtest_button(1, true);
    for (int i = 0; i < 20; i++) {
        xtest_move(window, 500 + 4 * i, 300 + i % 5);
        usleep(10000);
    }
    xtest_button(1, false);
    assert_true(heard("Ink: ", true));
    control_type(XK_z);
    assert_true(heard("Ink: ", false));
    xtest_key(XK_Control_L, true);
    xtest_key(XK_Shift_L, true);
    xtest_type(XK_z);
    xtest_key(XK_Shift_L, false);
    xtest_key(XK_Control_L, false);
    assert_true(heard("Ink: ", true));
    choices_are_heard();
    xtest_type(XK_n);
    assert_true(heard("Erase this note", true));
    usleep(300000);
    xtest_type(XK_w);
    xtest_type(XK_h);
    xtest_type(XK_y);
    assert_true(heard("why", true));
    sleep(1); /* it is written as it is typed */
}

/* The window has been killed: what was left in it is kept. */
static void notes_are_kept(void **state)
{
    (void)state;
    char path[80];
    struct reader_remarks *remarks;
    int ink = 0, typed = 0;
    snprintf(path, sizeof path, "%s.notes", document);
    assert_int_equal(reader_remarks_open(path, &remarks), READER_OK);
    for (int i = 0; i < reader_remarks_count(remarks); i++) {
        const struct reader_remark *r = reader_remarks_get(remarks, i);
        ink += r->kind == READER_REMARK_INK && r->gone_s == 0 && r->points_count > 2;
        typed += r->kind == READER_REMARK_TYPED && strcmp(r->text, "why") == 0;
    }
    assert_int_equal(ink, 1);
    assert_int_equal(typed, 1);
    reader_remarks_close(remarks);
}

static bool document_write(void)
{
    if (!mkdtemp(folder))
        return false;
    snprintf(document, sizeof document, "%s/one.md", folder);
    FILE *file = fopen(document, "w");
    if (!file)
        return false;
    fputs("# One\n\nA word[^a].\n\n[^a]: What the note says.\n\n", file);
    for (int i = 0; i < 60; i++)
        fprintf(file,
                "## Chapter %d\n\nThe reeds of paragraph %d stand in water that goes by.\n\n",
                i, i);
    fputs("```lua live 200x60\n"
          "local a = control{name = 'speed', least = 0, most = 4, usual = 1.0625}\n"
          "function draw() print(string.format('speed <%g>', a())) return '#808080' end\n"
          "```\n\n## Last\n\n```lua live 200x60\n-- two\n```\n\n```lua live 200x60\n-- "
          "three\n```\n",
          file);
    return fclose(file) == 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_heard), cmocka_unit_test(keys_and_wheel_scroll),
        cmocka_unit_test(demonstrations_have_names), cmocka_unit_test(controls_are_reached),
        cmocka_unit_test(hand_leaves_notes)};
    const struct CMUnitTest again[] = {cmocka_unit_test(notes_are_kept)};
    char command[100];
    if (argc == 1) { /* with a bus of its own */
        execlp("dbus-run-session", "dbus-run-session", "--", argv[0], "with-bus", NULL);
        puts("[  SKIPPED ] dbus-run-session is not installed");
        return 77;
    }
    if (!screen_start("1280x900x24"))
        return 77;
    if (!document_write())
        return 1;
    atspi_init();
    int failed = cmocka_run_group_tests(tests, start, end);
    failed += cmocka_run_group_tests(again, NULL, NULL);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) == 0 ? failed : 1;
}

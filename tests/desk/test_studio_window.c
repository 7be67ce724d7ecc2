/* test_studio_window.c - the studio's window on an Xvfb, played recorded input in place of a hand: what it saves is what the paper's own
 * functions make of the same deeds, bit for bit; and what it says when something is wrong. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <brush.h>
#include <display.h>
#include <state.h>

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../lutetia/child.h"
#include "studio_scene.h"
#include "xvfb.h"

static char folder[] = "/tmp/lutetia-studio-XXXXXX";
static struct child child;

static const char *in_folder(const char *name)
{
    static char paths[8][128];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static FILE *events_begin(void)
{
    FILE *file = fopen(in_folder("hand.events"), "w");
    assert_non_null(file);
    return file;
}

/* Runs the window with the events until they close it. */
static void studio_run(const char *variable)
{
    memset(&child, 0, sizeof child);
    const char *const arguments[] = {getenv("LUTETIA"), "studio",
                                     "--paper",         "96x72",
                                     "--pigment",       "french ultramarine",
                                     "--pigment",       "quinacridone rose",
                                     "--play",          in_folder("hand.events")};
    memcpy(child.arguments, arguments, sizeof arguments);
    child.variables[0] = "GTK_A11Y=none"; /* no bus is needed for this */
    child.variables[1] = variable;
    child_run(&child);
}

static size_t file_read(const char *path, char **bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    const size_t count = (size_t)ftell(file);
    rewind(file);
    *bytes = malloc(count + 1);
    assert_non_null(*bytes);
    assert_int_equal(fread(*bytes, 1, count, file), count);
    fclose(file);
    return count;
}

/* ---- what is painted ---- */

static void expected_write(const char *path)
{
    static uint16_t rgb[3 * SCENE_WIDTH * SCENE_HEIGHT];
    const struct paper_sheet_config config = scene_config();
    struct paper_sheet *sheet;
    struct paper_sheet_view view = paper_sheet_view_default(&config);
    view.show = PAPER_SHOW_WET;
    assert_int_equal(paper_sheet_create(&config, &sheet), PAPER_OK);
    assert_int_equal(paper_history_begin(sheet, 0), PAPER_OK);
    assert_int_equal(scene_paint(sheet), PAPER_OK);
    assert_int_equal(paper_sheet_view(sheet, &view, rgb), PAPER_OK);
    assert_int_equal(display_png_write_16(path, SCENE_WIDTH, SCENE_HEIGHT, 3, rgb), DISPLAY_OK);
    paper_sheet_destroy(sheet);
}

static void window_paints_what_calls_paint(void **state)
{
    (void)state;
    char *seen, *expected;
    FILE *events = events_begin();
    scene_write(events, 4);
    fprintf(
        events,
        "4 picture %s\n4 script %s\n4 set show colour\n4 picture %s\n4 script %s\n4 close\n",
        in_folder("seen.png"), in_folder("scene.lua"), in_folder("colour.png"),
        in_folder("bare.lua"));
    fclose(events);
    studio_run(NULL);
    if (child.status != 0)
        print_message("%s", child.errors);
    assert_int_equal(child.status, 0);
    expected_write(in_folder("expected.png"));
    const size_t count = file_read(in_folder("seen.png"), &seen),
                 wanted = file_read(in_folder("expected.png"), &expected);
    assert_int_equal(count, wanted);
    assert_memory_equal(seen, expected, count);
    free(seen);
    free(expected);
}

/* What a script of the session before makes is the picture that was written where it was: all 16 bits, and shown as it was. */
static void script_is(const char *script, const char *made, const char *picture)
{
    char *seen, *expected;
    memset(&child, 0, sizeof child);
    const char *const arguments[] = {getenv("LUTETIA"), "run", in_folder(script), "-q", "-o",
                                     in_folder("made")};
    memcpy(child.arguments, arguments, sizeof arguments);
    child_run(&child);
    if (child.status != 0)
        print_message("%s", child.errors);
    assert_int_equal(child.status, 0);
    const size_t count = file_read(in_folder(made), &seen),
                 wanted = file_read(in_folder(picture), &expected);
    assert_int_equal(count, wanted);
    assert_memory_equal(seen, expected, count);
    free(seen);
    free(expected);
}

static void script_makes_the_same(void **state)
{
    (void)state;
    script_is("scene.lua", "made/scene.png", "seen.png");
    script_is("bare.lua", "made/bare.png", "colour.png");
}

/* How many operations of that name the saved sheet has. */
static int saved_count(const char *name, const char *what)
{
    struct paper_state *file;
    struct paper_sheet *sheet;
    struct paper_moment moment;
    int count = 0;
    assert_int_equal(paper_state_open(in_folder(name), &file), PAPER_OK);
    assert_int_equal(paper_state_load(file, 0, false, 0, &sheet), PAPER_OK);
    for (int i = 0; paper_history_moment(sheet, i, &moment); i++)
        count += strcmp(moment.what, what) == 0;
    paper_sheet_destroy(sheet);
    paper_state_close(file);
    return count;
}

/* Saved, and closed, in mid-stroke; the focus lost in another one: each is one stroke, and none is lost. */
static void closed_in_mid_stroke(void **state)
{
    (void)state;
    FILE *events = events_begin();
    fprintf(events,
            "0 set paused on\n0 down -20 0 0.5\n0.05 move 0 5 0.6\n0.1 move 20 0 0.6\n");
    fprintf(events, "0.2 focus-lost\n0.3 move 30 30 0.5\n0.3 up 30 30 0.5\n");
    fprintf(events, "0.4 down -20 20 0.5\n0.45 set tool blot\n0.5 move 0 25 0.6\n");
    fprintf(events, "0.5 save %s\n0.55 move 20 20 0.6\n0.6 close\n", in_folder("mid.h5"));
    fclose(events);
    studio_run(NULL);
    assert_int_equal(child.status, 0);
    assert_int_equal(saved_count("mid.h5", "stroke"), 2);
    assert_int_equal(saved_count("mid.h5", "blot"), 0);
}

/* ---- what was not saved ---- */

/* The journal of the only sheet that was not saved; false: there is none. */
static bool journal_find(char *path, size_t room)
{
    char folder_of[160];
    snprintf(folder_of, sizeof folder_of, "%s/lutetia/studio", folder);
    DIR *names = opendir(folder_of);
    bool found = false;
    for (struct dirent *entry; names && (entry = readdir(names));)
        if (strstr(entry->d_name, ".journal") && !strstr(entry->d_name, ".part")) {
            snprintf(path, room, "%s/%.80s", folder_of, entry->d_name);
            found = true;
        }
    if (names)
        closedir(names);
    return found;
}

/* Killed while nobody had saved: all that is older than a second is there again, and what the journal has lost is lost alone. */
static void killed_and_found_again(void **state)
{
    (void)state;
    char *seen, *expected, journal[300];
    struct stat now, before = {0};
    FILE *events = events_begin();
    scene_write(events, 2);
    fprintf(events, "4 picture %s\n", in_folder("done.png"));
    fclose(events);
    const pid_t studio = fork();
    if (studio == 0) {
        setenv("GTK_A11Y", "none", 1);
        execl(getenv("LUTETIA"), "lutetia", "studio", "--paper", "96x72", "--pigment",
              "french ultramarine", "--pigment", "quinacridone rose", "--play",
              in_folder("hand.events"), NULL);
        _exit(127);
    }
    /* until it has not grown for some seconds after the picture that follows the last deed */
    for (int still = 0, turns = 0; still < 50 && turns < 2000; turns++) {
        usleep(100000);
        const bool there = access(in_folder("done.png"), R_OK) == 0 &&
                           journal_find(journal, sizeof journal) && stat(journal, &now) == 0;
        still = there && now.st_size == before.st_size ? still + 1 : 0;
        before = there ? now : before;
    }
    kill(studio, SIGKILL);
    waitpid(studio, NULL, 0);
    assert_true(journal_find(journal, sizeof journal));
    events = events_begin();
    fprintf(events, "0 picture %s\n0.1 save %s\n0.1 close\n", in_folder("seen.png"),
            in_folder("mid.h5"));
    fclose(events);
    memset(&child, 0, sizeof child);
    const char *const arguments[] = {getenv("LUTETIA"), "studio", "--play",
                                     in_folder("hand.events")};
    memcpy(child.arguments, arguments, sizeof arguments);
    child.variables[0] = "GTK_A11Y=none";
    child_run(&child);
    assert_int_equal(child.status, 0);
    expected_write(in_folder("expected.png"));
    const size_t count = file_read(in_folder("seen.png"), &seen),
                 wanted = file_read(in_folder("expected.png"), &expected);
    assert_int_equal(count, wanted);
    assert_memory_equal(seen, expected, count);
    free(seen);
    free(expected);
    assert_false(journal_find(journal, sizeof journal)); /* saved: it is not needed any more */
}

/* ---- what is wrong ---- */

/* One line that says so. */
static void says(int status, const char *what)
{
    if (child.status != status || !strstr(child.errors, what))
        print_message("%d: %s", child.status, child.errors);
    assert_int_equal(child.status, status);
    const char *line = strstr(child.errors, "lutetia studio: ");
    assert_non_null(line);
    assert_non_null(strstr(line, what));
    assert_null(strstr(line + 1, "lutetia studio: "));
}

static void wrong_is_one_line(void **state)
{
    (void)state;
    FILE *events = events_begin();
    fprintf(events, "0 down 0 0\n0.1 up 5 5\n0.2 save /proc/sheet.h5\n0.3 close\n");
    fclose(events);
    studio_run(NULL);
    says(1, "/proc/sheet.h5");
    studio_run("GDK_DEBUG=gl-disable");
    if (!strstr(child.errors, "OpenGL")) /* later ones name it otherwise */
        studio_run("GDK_DISABLE=gl");
    says(1, "OpenGL");
    studio_run("DISPLAY=:4711");
    says(1, "no display");
    events = events_begin();
    fprintf(events, "0 down 0 0\n0.1 jump\n");
    fclose(events);
    studio_run(NULL);
    says(1, "hand.events:2: no such word: 'jump'");
}

static void wrong_files_are_told(void **state)
{
    (void)state;
    FILE *file = fopen(in_folder("bad.h5"), "w");
    assert_non_null(file);
    fputs("this is no sheet", file);
    fclose(file);
    memset(&child, 0, sizeof child);
    child.arguments[0] = getenv("LUTETIA");
    child.arguments[1] = "studio";
    child.arguments[2] = in_folder("bad.h5");
    child.variables[0] = "GTK_A11Y=none";
    child_run(&child);
    says(1, "bad.h5");
    child.arguments[2] = "/no/such.h5";
    child_run(&child);
    says(1, "/no/such.h5: cannot read");
}

static int folder_make(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    setenv("XDG_DATA_HOME", folder, 1); /* where sheets are kept that were not saved */
    return 0;
}

static int folder_remove(void **state)
{
    char command[160];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(window_paints_what_calls_paint),
        cmocka_unit_test(script_makes_the_same),
        cmocka_unit_test(closed_in_mid_stroke),
        cmocka_unit_test(killed_and_found_again),
        cmocka_unit_test(wrong_is_one_line),
        cmocka_unit_test(wrong_files_are_told),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}

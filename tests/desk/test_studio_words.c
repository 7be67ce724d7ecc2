/* test_studio_words.c - all that the studio says can be translated: with a translation that
 * puts every text in brackets (marked_words.c), a screen reader finds none without them but
 * names of paints and papers, numbers, keys, and the toolkit's own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <atspi/atspi.h>
#include <paper.h>
#include <sheet.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "accessible.h"
#include "xtest.h"

enum { WAIT_S = 60 };

/* What has no translation of ours: the sheet's paints, numbers, keys, the toolkit's words. */
static bool is_data(const char *text)
{
    static const char *const toolkits[] = {"GtkDrawingArea",
                                           "GtkRange",
                                           "GtkLabel",
                                           "GtkOverlay",
                                           "Close",
                                           "Close the window",
                                           "Maximize",
                                           "Maximize the window",
                                           "Minimize",
                                           "Minimize the window",
                                           NULL};
    for (int i = 0; toolkits[i]; i++)
        if (strcmp(text, toolkits[i]) == 0)
            return true;
    for (int i = 0; paper_pigment_number(i); i++)
        if (strcmp(text, paper_pigment_number(i)->name) == 0)
            return true;
    if (text[0] >= 'A' && text[0] <= 'Z' && !text[1])
        return true;
    return strspn(text, "0123456789.,-+x%/() ") == strlen(text);
}

struct words {
    int marked, bare;
};

static void text_check(struct words *words, const char *text, const char *what)
{
    if (!text || !text[0] || is_data(text))
        return;
    if (strchr(text, '[')) {
        words->marked++;
        return;
    }
    print_message("%s '%s' cannot be translated\n", what, text);
    words->bare++;
}

static void words_check(AtspiAccessible *a, void *context)
{
    char *name = atspi_accessible_get_name(a, NULL),
         *description = atspi_accessible_get_description(a, NULL);
    text_check(context, name, "the name");
    text_check(context, description, "the description");
    g_free(name);
    g_free(description);
}

static void all_words_are_looked_up(void **state)
{
    (void)state;
    struct words words = {0};
    const pid_t studio = fork();
    if (studio == 0) {
        setenv("LD_PRELOAD", getenv("MARKED_WORDS"), 1);
        execl(getenv("STUDIO_PROGRAM"), "lutetia-studio", "fresh=1", "width=128", "height=96",
              "stock=hot press", "pigment=french ultramarine", NULL);
        _exit(127);
    }
    AtspiAccessible *frame = accessible_frame_wait(WAIT_S);
    assert_non_null(frame);
    sleep(2);
    atspi_accessible_clear_cache(frame);
    accessible_walk(frame, words_check, &words);
    g_object_unref(frame);
    kill(studio, SIGTERM);
    waitpid(studio, NULL, 0);
    print_message("%d texts are looked up, %d are not\n", words.marked, words.bare);
    assert_int_equal(words.bare, 0);
    assert_true(words.marked > 100);
}
int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_words_are_looked_up)};
    if (argc == 1) { /* with a bus of its own */
        execlp("dbus-run-session", "dbus-run-session", "--", argv[0], "with-bus", NULL);
        puts("[  SKIPPED ] dbus-run-session is not installed");
        return 77;
    }
    if (!screen_start("1600x1200x24"))
        return 77;
    setenv("XDG_DATA_HOME", "/proc/none", 1); /* nothing is found again, and nothing kept */
    atspi_init();
    return cmocka_run_group_tests_name("studio words", tests, NULL, NULL);
}

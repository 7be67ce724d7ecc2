/* test_reader_keys.c - the reader's window is edited by keys of the X server: letters, a dead
 * key, the caret's ways, undo, saving, and a click. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <X11/Xutil.h>
#include <X11/keysym.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../display/xtest.h"

enum { WAIT_S = 20 };

static char folder[] = "/tmp/lutetia-keys-XXXXXX", path[100];
static pid_t reader;
static Window window;

static void document_write(void)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("A first line.\n\nThe last word\n", file);
    fclose(file);
}

/* Waits until the file says this. */
static void file_says(const char *what)
{
    char bytes[400] = "";
    for (int i = 0; i < 10 * WAIT_S; i++) {
        FILE *file = fopen(path, "r");
        if (file) {
            bytes[fread(bytes, 1, sizeof bytes - 1, file)] = '\0';
            fclose(file);
        }
        if (strcmp(bytes, what) == 0)
            return;
        usleep(100000);
    }
    assert_string_equal(bytes, what);
}

/* A key that no other test needs is a dead one. */
static void dead_key_make(void)
{
    KeySym dead = XK_dead_acute;
    Display *display = screen_display();
    XChangeKeyboardMapping(display, XKeysymToKeycode(display, XK_F11), 1, &dead, 1);
    XSync(display, False);
}

static void with_control(KeySym key)
{
    xtest_key(XK_Control_L, true);
    xtest_type(key);
    xtest_key(XK_Control_L, false);
}

static int start(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/one.md", folder);
    document_write();
    dead_key_make();
    setenv("GTK_A11Y", "none", 1);
    setenv("GTK_IM_MODULE", "gtk-im-context-simple", 1);
    reader = fork();
    if (reader == 0) {
        execl(getenv("LUTETIA"), "lutetia", "read", path, "--theme", "light", NULL);
        _exit(127);
    }
    window = screen_window("Reader", WAIT_S);
    if (!window)
        return -1;
    XSetInputFocus(screen_display(), window, RevertToParent, CurrentTime);
    XSync(screen_display(), False);
    usleep(500000);
    return 0;
}

static int end(void **state)
{
    char command[160];
    int status;
    (void)state;
    kill(reader, SIGKILL);
    waitpid(reader, &status, 0);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void keys_edit(void **state)
{
    (void)state;
    xtest_type(XK_F2);
    usleep(300000);
    with_control(XK_End);
    xtest_type(XK_s);
    xtest_type(XKeysymToKeycode(screen_display(), XK_dead_acute) ? XK_dead_acute : XK_F11);
    xtest_type(XK_e);
    with_control(XK_s);
    file_says("A first line.\n\nThe last words\xc3\xa9\n");
    with_control(XK_BackSpace);
    xtest_type(XK_w);
    xtest_type(XK_Return);
    xtest_type(XK_x);
    with_control(XK_s);
    file_says("A first line.\n\nThe last w\n\nx\n");
    with_control(XK_z);
    with_control(XK_z);
    with_control(XK_z);
    with_control(XK_z);
    with_control(XK_s);
    file_says("A first line.\n\nThe last word\n");
}

/* Letters that mean something else while one reads. */
static void letters_are_letters(void **state)
{
    (void)state;
    with_control(XK_Home);
    xtest_type(XK_h);
    xtest_type(XK_n);
    xtest_type(XK_d);
    xtest_type(XK_space);
    with_control(XK_s);
    file_says("hnd A first line.\n\nThe last word\n");
    xtest_type(XK_Escape); /* one reads again */
    usleep(200000);
    xtest_type(XK_j);
    with_control(XK_s);
    usleep(500000);
    file_says("hnd A first line.\n\nThe last word\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_edit),
        cmocka_unit_test(letters_are_letters),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, start, end);
}

/* LUTETIA_LEDS=window, LUTETIA_DISPLAY=window: a verb of `lutetia` shows in a window what it
 * reads from a pipe.
 *
 * The viewer is this program's child, and outlives it, so that the last picture stays visible.
 * It writes a byte to its standard output, which is a pipe, too, when the window is ready.
 * If the user closes the window before this program has ended, the viewer interrupts the
 * program (LUTETIA_LEDS_PROGRAM, LUTETIA_DISPLAY_PROGRAM give the process).
 */
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "paris_state.h"
#include "recording.h"

enum { ADDED = 2 };

static bool names_one_of(const char *entry, char *const added[ADDED])
{
    bool names = false;
    for (int i = 0; i < ADDED; i++)
        names = names || strncmp(entry, added[i], strcspn(added[i], "=") + 1) == 0;
    return names;
}

/* The environment with those variables added. Owns: the caller frees the array. */
static char **environment_with(char *const added[ADDED])
{
    size_t count = 0, kept = 0;
    while (environ[count])
        count++;
    char **all = malloc((count + ADDED + 1) * sizeof *all);
    for (size_t i = 0; all && i < count; i++)
        if (!names_one_of(environ[i], added))
            all[kept++] = environ[i];
    for (int i = 0; all && i < ADDED; i++)
        all[kept++] = added[i];
    if (all)
        all[kept] = NULL;
    return all;
}

/* Runs the viewer with these descriptors as its standard input and output; returns 0, or an
 * errno. */
static int viewer_spawn(const struct paris_recording *of, int input, int output)
{
    char lutetia[] = "lutetia", verb[16], window[] = "--window", standard_input[] = "-";
    char *arguments[] = {lutetia, verb, window, standard_input, NULL};
    char program[160], room[64 + PICTURE_ROOM_TEXT], text[PICTURE_ROOM_TEXT] = "";
    const int shared = of->room.at ? of->room.descriptor : -1;
    snprintf(verb, sizeof verb, "%s", of->verb);
    snprintf(program, sizeof program, "%s_PROGRAM=%ld %.100s", of->variable, (long)getpid(),
             program_invocation_short_name);
    if (shared >= 0)
        picture_room_text(&of->room, standard_input, text);
    snprintf(room, sizeof room, "%s_ROOM=%s", of->variable, text);
    char **environment = environment_with((char *const[ADDED]){program, room});
    posix_spawn_file_actions_t actions;
    pid_t child;
    int error = ENOMEM;
    if (environment && posix_spawn_file_actions_init(&actions) == 0) {
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
        if (shared >= 0) /* onto itself: it stays open in the child */
            posix_spawn_file_actions_adddup2(&actions, shared, shared);
        error = posix_spawnp(&child, lutetia, &actions, NULL, arguments, environment);
        if (error == ENOENT) /* not in PATH: try the place where it was installed with this
                              * library */
            error = posix_spawn(&child, LUTETIA_BINDIR "/lutetia", &actions, NULL, arguments,
                                environment);
        posix_spawn_file_actions_destroy(&actions);
    }
    free(environment);
    return error;
}

/* Makes a pipe with descriptors above 2: 0, 1 and 2, which a program may have closed, become
 * the child's. */
static bool pipe_make(int ends[2])
{
    int low[2];
    if (pipe2(low, O_CLOEXEC) != 0)
        return false;
    for (int i = 0; i < 2; i++) {
        ends[i] = fcntl(low[i], F_DUPFD_CLOEXEC, 3);
        close(low[i]);
    }
    return ends[0] >= 0 && ends[1] >= 0;
}

static bool is_set(const char *name)
{
    const char *value = getenv(name);
    return value && *value;
}

int paris_viewer_open(struct paris_recording *of)
{
    int frames[2] = {-1, -1}, answer[2] = {-1, -1}, error = 0, result = -1;
    char byte;
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
        paris_fail("%s=window: no display: neither DISPLAY nor WAYLAND_DISPLAY is set; "
                   "name a file for a recording instead",
                   of->variable);
        return -1;
    }
    if (!pipe_make(frames) || !pipe_make(answer))
        error = errno;
    if (!error && of->room_wanted)
        picture_room_make(&of->room); /* pictures go through the pipe without it */
    if (!error)
        error = viewer_spawn(of, frames[0], answer[1]);
    if (answer[1] >= 0)
        close(answer[1]);
    if (frames[0] >= 0)
        close(frames[0]);
    if (!error) {
        ssize_t count;
        while ((count = read(answer[0], &byte, 1)) < 0 && errno == EINTR)
            ;
        if (count == 1)
            result = frames[1];
    }
    if (answer[0] >= 0)
        close(answer[0]);
    if (result >= 0) {
        fcntl(result, F_SETPIPE_SZ, 1 << 20); /* a larger pipe, so that the program runs on
                                               * while a picture is drawn */
        return result;
    }
    picture_room_end(&of->room);
    if (frames[1] >= 0)
        close(frames[1]);
    if (error)
        paris_fail("%s=window: cannot run `lutetia %s`: %s; put lutetia into PATH, or "
                   "name a file for a recording instead",
                   of->variable, of->verb, strerror(error));
    else
        paris_fail("%s=window: `lutetia %s` opened no window; name a file for a "
                   "recording instead",
                   of->variable, of->verb);
    return -1;
}

/* xorg.c - see xorg.h. */
#include "xorg.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static pid_t server = -1;
static Display *display;

_Noreturn static void server_become(const char *folder, int descriptor)
{
    char config[80], log[80], number[16];
    const int nothing = open("/dev/null", O_WRONLY);
    snprintf(config, sizeof config, "%s/conf", folder);
    snprintf(log, sizeof log, "%s/log", folder);
    snprintf(number, sizeof number, "%d", descriptor);
    dup2(nothing, 1);
    dup2(nothing, 2);
    execlp("Xorg", "Xorg", "-displayfd", number, "-config", config, "-logfile", log, "-noreset",
           "-nolisten", "tcp", "-novtswitch", "-sharevts", (char *)NULL);
    _exit(127);
}

bool xorg_start(const char *folder)
{
    char name[32] = ":";
    int ends[2];
    size_t count = 1;
    ssize_t got = 1;
    if (pipe(ends) != 0)
        return false;
    server = fork();
    if (server == 0) {
        close(ends[0]);
        server_become(folder, ends[1]);
    }
    close(ends[1]);
    while (got > 0 && count < sizeof name - 1 && !strchr(name, '\n')) {
        got = read(ends[0], name + count, sizeof name - 1 - count);
        count += got > 0 ? (size_t)got : 0;
    }
    close(ends[0]);
    if (!strchr(name, '\n'))
        return false;
    *strchr(name, '\n') = '\0';
    setenv("DISPLAY", name, 1);
    unsetenv("WAYLAND_DISPLAY");
    display = XOpenDisplay(NULL);
    return display != NULL;
}

Display *xorg_display(void)
{
    return display;
}

void xorg_end(const char *folder)
{
    char command[80];
    if (display)
        XCloseDisplay(display);
    if (server > 0) {
        kill(server, SIGTERM);
        waitpid(server, NULL, 0);
    }
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0)
        fprintf(stderr, "%s is left\n", folder);
}

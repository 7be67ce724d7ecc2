/* peer.c - see peer.h. */
#include "peer.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness.h"

extern char **environ;

enum { EXIT_MISSING = 3 };

struct bench_peer {
    size_t field_bytes;
    pid_t child;
    FILE *to, *from;
};

/* Debian's modules belong to Debian's Python, which may not be the first in the path. */
static const char *const pythons[] = {"/usr/bin/python3", "python3"};

static bool child_start(struct bench_peer *p, const char *python, const char *script,
                        const char *argument)
{
    int down[2] = {-1, -1}, up[2] = {-1, -1};
    const char *const arguments[] = {python, "-c", script, argument, NULL};
    posix_spawn_file_actions_t actions;
    /* The ends must not be inherited by another peer. */
    if (pipe2(down, O_CLOEXEC) || pipe2(up, O_CLOEXEC))
        return bench_fail("a pipe could not be made: %s", strerror(errno));
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, down[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, up[1], STDOUT_FILENO);
    char *copies[5] = {0};
    for (int i = 0; arguments[i]; i++)
        copies[i] = strdup(arguments[i]);
    int error = posix_spawnp(&p->child, python, &actions, NULL, copies, environ);
    for (int i = 0; i < 4; i++)
        free(copies[i]);
    posix_spawn_file_actions_destroy(&actions);
    close(down[0]);
    close(up[1]);
    p->to = fdopen(down[1], "w");
    p->from = fdopen(up[0], "r");
    if (error)
        p->child = 0;
    return !error && p->to && p->from;
}

/* The child's exit status; -1 if there was none. */
static int child_end(struct bench_peer *p)
{
    int status = 0;
    if (p->to)
        fclose(p->to);
    if (p->from)
        fclose(p->from);
    p->to = p->from = NULL;
    if (p->child <= 0 || waitpid(p->child, &status, 0) != p->child || !WIFEXITED(status))
        return -1;
    return WEXITSTATUS(status);
}

static bool answered(struct bench_peer *p, const char *wanted)
{
    char line[32];
    return fgets(line, sizeof line, p->from) && !strncmp(line, wanted, strlen(wanted));
}

static bool scene_send(struct bench_peer *p, const struct diffusion_scene *s)
{
    fprintf(p->to, "%d %d %d %d %d %d %a %a %a %a\n", s->width, s->height, s->x0, s->y0, s->x1,
            s->y1, (double)s->gravity, (double)s->molecular_weight[0],
            (double)s->molecular_weight[1], (double)s->molecular_weight[2]);
    bool ok = fwrite(s->absorbency, p->field_bytes, 1, p->to) == 1;
    for (int i = 0; ok && i < DIFFUSION_FIELDS_COUNT; i++)
        ok = fwrite(s->field[i], p->field_bytes, 1, p->to) == 1;
    return ok && !fflush(p->to);
}

struct bench_peer *bench_peer_start(const struct diffusion_scene *s, const char *script,
                                    const char *argument, bool *missing)
{
    struct bench_peer *p = calloc(1, sizeof *p);
    *missing = false;
    if (!p) {
        bench_fail("no memory");
        return NULL;
    }
    p->field_bytes = (size_t)s->width * (size_t)s->height * sizeof(float);
    signal(SIGPIPE, SIG_IGN); /* writing to a dead child must be an error, not end this
                               * process */
    for (size_t i = 0; i < sizeof pythons / sizeof *pythons; i++) {
        if (!child_start(p, pythons[i], script, argument)) {
            child_end(p);
            continue; /* no such Python */
        }
        if (scene_send(p, s) && answered(p, "ready"))
            return p;
        int status = child_end(p);
        if (status != EXIT_MISSING && status != 127) {
            bench_fail("a peer in Python ended with status %d before its first step", status);
            free(p);
            return NULL;
        }
    }
    *missing = true;
    free(p);
    return NULL;
}

void bench_peer_stop(struct bench_peer *p)
{
    if (p)
        child_end(p);
    free(p);
}

bool bench_peer_steps(struct bench_peer *p, int steps_count)
{
    fprintf(p->to, "steps %d\n", steps_count);
    return (!fflush(p->to) && answered(p, "done")) || bench_fail("a peer in Python has ended");
}

bool bench_peer_read(struct bench_peer *p, int field, float *out)
{
    fprintf(p->to, "read %d\n", field);
    return (!fflush(p->to) && fread(out, p->field_bytes, 1, p->from) == 1) ||
           bench_fail("a peer in Python has ended");
}

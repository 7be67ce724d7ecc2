/* fuzz_sessions.c - sessions from damaged text. Each is refused in one line, or it is read,
 * written and read again as the same, and done on a stage of springs, where nothing explodes
 * and all can be undone. */
#include <session.h>
#include <springs.h>
#include <stage.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static char path[100];
static long read_count;

static void path_remove(void)
{
    if (*path)
        remove(path);
}

static void path_make(void)
{
    if (*path)
        return;
    snprintf(path, sizeof path, "/tmp/lutetia-fuzz-%ld.session", (long)getpid());
    atexit(path_remove);
}

/* A box of springs above a floor, one corner tacked, that a session's hands can reach. */
static struct stage *stage_make(void)
{
    struct stage_springs_def def = stage_springs_def_default();
    struct stage_def stage_def = stage_def_default();
    struct stage *stage;
    if (dyn_network_create(&def.network) != DYN_OK)
        abort();
    for (int i = 0; i < 4; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = i & 1;
        mass.y = 1 + (i >> 1);
        mass.hold = i == 3 ? DYN_STUCK : DYN_FREE;
        if (dyn_mass_add(def.network, &mass, NULL) != DYN_OK)
            abort();
    }
    for (int a = 0; a < 4; a++)
        for (int b = a + 1; b < 4; b++) {
            struct dyn_spring spring = dyn_spring_usual();
            spring.end[0] = a;
            spring.end[1] = b;
            if (dyn_spring_add(def.network, &spring, NULL) != DYN_OK)
                abort();
        }
    if (stage_springs_create(&def, &stage_def.actor) != STAGE_OK ||
        stage_create(&stage_def, &stage) != STAGE_OK)
        abort();
    return stage;
}

static void refused(enum stage_status status)
{
    if (status != STAGE_BAD_FILE || !*stage_error() || strchr(stage_error(), '\n'))
        abort();
}

static bool thesis_chosen(const struct dyn_network *n)
{
    return dyn_network_world(n)->integrator == DYN_THESIS; /* it may explode */
}

/* Does it for some steps, then takes all back. */
static void session_do(struct stage *stage)
{
    enum { FRAMES = 40 };
    struct stage_actor actor = stage_actor(stage);
    const struct dyn_network *n = stage_springs_network(&actor);
    enum stage_status status = stage_session_replay(stage, path);
    bool wild = false;
    for (int i = 0; i < FRAMES && status == STAGE_OK; i++) {
        frame_clock_single(stage_clock(stage));
        status = stage_frame(stage, i / 60.0, NULL);
        n = stage_springs_network(&actor);
        wild = wild || thesis_chosen(n);
        for (int k = 0; k < dyn_masses_count(n) && !wild; k++)
            if (!(fabs(dyn_network_states(n)[k].x) <= 1e6 &&
                  fabs(dyn_network_states(n)[k].y) <= 1e6))
                abort();
    }
    if (status != STAGE_OK)
        refused(status); /* a file that it loads */
    while (stage_undo(stage))
        ;
    if (stage_reset(stage) != STAGE_OK)
        abort();
}

static void written_again(struct stage *stage, const struct stage_session *s)
{
    struct stage_session again;
    int rows_count;
    const struct control *rows = stage_controls(stage, &rows_count);
    if (stage_session_write(s, rows, path) != STAGE_OK)
        abort();
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t capacity = 0;
    ssize_t count = file ? getdelim(&text, &capacity, '\0', file) : -1;
    if (count < 0 ||
        stage_session_parse(text, (size_t)count, "again", rows, rows_count, &again) != STAGE_OK)
        abort();
    fclose(file);
    free(text);
    if (again.count != s->count || again.files_count != s->files_count ||
        again.texts_count != s->texts_count || again.begin != s->begin || again.end != s->end)
        abort();
    for (int i = 0; i < s->count; i++)
        if (again.deeds[i].step != s->deeds[i].step || again.deeds[i].kind != s->deeds[i].kind)
            abort();
    for (int i = 0; i < s->texts_count; i++)
        if (strcmp(again.texts[i], s->texts[i]) != 0)
            abort();
    stage_session_finish(&again);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct stage_session s;
    struct stage *stage = stage_make();
    int rows_count;
    const struct control *rows = stage_controls(stage, &rows_count);
    char *text = malloc(count ? count : 1); /* its end is where a sanitizer sees it */
    path_make();
    if (!text)
        abort();
    memcpy(text, bytes, count);
    enum stage_status status = stage_session_parse(text, count, "fuzz", rows, rows_count, &s);
    free(text);
    if (status == STAGE_OK) {
        read_count++;
        written_again(stage, &s);
        session_do(stage);
        stage_session_finish(&s);
    } else {
        refused(status);
    }
    stage_destroy(stage);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "damage.h"

int main(void)
{
    static const char *const seeds[] = {
        "session 1\n0 mark\n0 hand down 0 1 0.3 0 0 0\n3 hand move 1 2 0.3 0 0 0\n9 hand up 2 "
        "2 0.3 0 0 0\n"
        "12 set gravity -40\n13 text a\\\\b\\nc d\n14 set stiffness 1000\n20 undo\n30 "
        "reset\nend\n",
        "session 1\n# cut, tack, let go\n1 mark\n1 hand down -1 1.5 0.3 0 1 0\n5 hand move 3 "
        "1.5 0.3 0 1 0\n"
        "6 hand up 3 1.5 0.3 0 1 0\n8 hand down 1 1 0.4 0.9 0 1\n9 hand cancel 0 0 0.4 0 0 "
        "0\n10 drop\nend 12\n",
        ("session 1\n2 mark\n2 load 0123456789abcdef /no such file\n4 set restitution 1\n4 set "
         "rate 2\nend\n"),
    };
    enum { ROUNDS = 1500 };
    for (uint64_t i = 0; i < ROUNDS; i++) {
        char text[DAMAGE_MOST];
        size_t count = damage(seeds[i % 3], i, text);
        LLVMFuzzerTestOneInput((const uint8_t *)text, count);
    }
    return read_count > ROUNDS / 20 && read_count < ROUNDS ? 0 : 1; /* enough are read, too */
}
#endif

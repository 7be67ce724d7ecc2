/* midi.c - `lutetia bench midi`: how long a note takes from an instrument to a program.
 *
 * A pseudo-terminal stands for the instrument; the server is a process, and so is each of 16
 * programs that listen. A thousand notes a second, five rounds of a thousand; each delivery is
 * timed, from before the write at the instrument's end to after the read in the program. The
 * cases are: an idle machine; the same whose processors may sleep between notes; as many busy
 * processes as processors; the first and the last with real-time priority for the server, the
 * programs and the player, where that is allowed; and these two again with the kernel's workers
 * that carry terminals' bytes before other programs (server_workers.h). Lost or altered
 * messages are errors. Then a program takes the place of the instrument, because those workers
 * have the usual priority else.
 *
 * At last what is played, seen and heard (midi_live.c).
 *
 * --thorough: ten minutes of soak, too. `lutetia bench midi --soak SECONDS`: that alone
 * (midi_soak.c).
 */
#include "bench.h"
#include "latency.h"
#include "midi_live.h"
#include "midi_scene.h"
#include "midi_soak.h"
#include "options.h"
#include <visible_text.h>

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LISTENERS = 16, NOTES = 1000, BUSY_MAX = 256, APART_US = 1000, SOAK_S = 600 };

struct busy {
    pid_t processes[BUSY_MAX];
    int count;
};

static void busy_begin(struct busy *b)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    for (b->count = 0; b->count < processors && b->count < BUSY_MAX; b->count++) {
        b->processes[b->count] = fork();
        if (b->processes[b->count] == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            for (;;)
                __asm__ volatile("" ::: "memory"); /* work that no compiler takes out */
        }
    }
}

static void busy_end(struct busy *b)
{
    for (int i = 0; i < b->count; i++)
        if (b->processes[i] > 0) {
            kill(b->processes[i], SIGKILL);
            waitpid(b->processes[i], NULL, 0);
        }
}

enum { P50, P99, READ_P99, PARTS };

static uint32_t notes(void)
{
    return (uint32_t)bench_many(NOTES, 20);
}

/* A round: its notes, a millisecond apart; what all listeners took for them, and what of it
 * went by until the server's read, in us. */
static bool round_measure(struct midi_scene *s, uint32_t from, double part_us[PARTS])
{
    static struct midi_histogram all, read;
    uint64_t due_ns = midi_now_ns();
    for (int i = 0; i < LISTENERS; i++) {
        memset(&s->shared->listeners[i].took, 0, sizeof s->shared->listeners[i].took);
        memset(&s->shared->listeners[i].read, 0, sizeof s->shared->listeners[i].read);
    }
    for (uint32_t i = 0; i < notes(); i++) {
        if (!midi_scene_play(s, from + i))
            return bench_fail("the instrument cannot write");
        due_ns += APART_US * UINT64_C(1000);
        const uint64_t now_ns = midi_now_ns();
        if (due_ns > now_ns) {
            const struct timespec left = {0, (long)(due_ns - now_ns)};
            ppoll(NULL, 0, &left, NULL);
        }
    }
    if (!midi_scene_wait(s, from + notes()))
        return false;
    memset(&all, 0, sizeof all);
    memset(&read, 0, sizeof read);
    for (int i = 0; i < LISTENERS; i++) {
        midi_histogram_join(&all, &s->shared->listeners[i].took);
        midi_histogram_join(&read, &s->shared->listeners[i].read);
    }
    part_us[P50] = midi_histogram_part(&all, 0.5) / 1e3;
    part_us[P99] = midi_histogram_part(&all, 0.99) / 1e3;
    part_us[READ_P99] = midi_histogram_part(&read, 0.99) / 1e3;
    return true;
}

struct kind_of_case {
    const char *load, *words;
    bool loaded, real_time, may_sleep, terminals_first;
};

static void rows_add(struct bench_report *r, enum midi_player player,
                     const struct kind_of_case *kind, double *us, int rounds)
{
    static const char *const whats[] = {"server", "server, from a program"};
    for (int part = 0; part < PARTS; part++) {
        char row[32];
        if (part == READ_P99 && player == MIDI_FROM_PROGRAM)
            continue; /* such a message's time is the program's */
        snprintf(row, sizeof row, "%s p%s%s", kind->load, part == P50 ? "50" : "99",
                 kind->words);
        bench_report_add(r, part == READ_P99 ? "terminal" : whats[player], row,
                         bench_sample_of(us + part * rounds, rounds), 1, "us");
    }
}

static bool case_measure(struct bench_report *r, enum midi_player player,
                         const struct kind_of_case *kind, int rounds)
{
    const struct midi_scene_def def = {player, kind->real_time, kind->may_sleep,
                                       kind->terminals_first};
    struct midi_scene scene;
    struct busy busy = {.count = 0};
    double *us = calloc(PARTS * (size_t)rounds, sizeof *us), one[PARTS];
    if (!us)
        return bench_fail("no memory for %d rounds", rounds);
    if (kind->loaded)
        busy_begin(&busy);
    bool ok = midi_scene_begin(&scene, &def) && midi_scene_listeners(&scene, LISTENERS, 0);
    ok = ok && round_measure(&scene, 0, one); /* warm */
    for (int i = 0; ok && i < rounds; i++) {
        ok = round_measure(&scene, (uint32_t)(i + 1) * notes(), one);
        for (int part = 0; ok && part < PARTS; part++)
            us[part * rounds + i] = one[part];
    }
    midi_scene_end(&scene);
    busy_end(&busy);
    if (ok)
        rows_add(r, player, kind, us, rounds);
    free(us);
    return ok;
}

static bool cases_measure(struct bench_report *r, int rounds)
{
    static const struct kind_of_case kinds[] = {
        {"idle", "", false, false, false, false},
        {"idle", ", may sleep", false, false, true, false},
        {"idle", ", real time", false, true, false, false},
        {"idle", ", terminals first", false, true, false, true},
        {"loaded", "", true, false, false, false},
        {"loaded", ", real time", true, true, false, false},
        {"loaded", ", terminals first", true, true, false, true}};
    const bool real_time = midi_real_time_allowed(), awake = midi_awake_allowed(),
               first = midi_terminals_first_allowed();
    bool ok = true;
    for (int player = MIDI_FROM_INSTRUMENT; player <= MIDI_FROM_PROGRAM; player++)
        for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
            if ((real_time || !kinds[i].real_time) && (awake || !kinds[i].may_sleep) &&
                ((first && player == MIDI_FROM_INSTRUMENT) || !kinds[i].terminals_first))
                ok = ok && case_measure(r, (enum midi_player)player, &kinds[i], rounds);
    if (!real_time)
        visible_say("lutetia bench midi: real time is not allowed here (`ulimit -r`); its "
                    "rows are missing");
    if (!awake)
        visible_say("lutetia bench midi: processors cannot be kept awake here "
                    "(" LATENCY_PATH "); they may sleep in all rows");
    if (!first)
        visible_say("lutetia bench midi: the system's workers cannot be changed here; rows of "
                    "terminals first are missing");
    return ok;
}

static bool soak_add(struct bench_report *r, double seconds)
{
    struct midi_soak_result soak;
    if (!midi_soak(seconds, &soak))
        return false;
    char name[32];
    snprintf(name, sizeof name, "%.0f s", seconds);
    const struct {
        const char *what, *unit;
        double value;
    } rows[] = {{"soak, deliveries", "messages", (double)soak.deliveries},
                {"soak, lost or altered", "messages", (double)soak.wrong},
                {"soak, programs killed", "programs", (double)soak.killed},
                {"soak, unplugged", "times", (double)soak.plugged},
                {"soak, OSC answered", "values", (double)soak.answers},
                {"soak, OSC or knobs wrong", "values", (double)soak.wrong_answers},
                {"soak, server's memory", "KiB", soak.server_kib},
                {"soak, server's memory grown", "KiB", soak.grown_kib},
                {"soak, stage's memory", "KiB", soak.stage_kib},
                {"soak, stage's memory grown", "KiB", soak.stage_grown_kib},
                {"soak, p50", "us", soak.p50_us},
                {"soak, p99", "us", soak.p99_us}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        bench_report_add(r, rows[i].what, name,
                         (struct bench_sample){rows[i].value, rows[i].value}, 1, rows[i].unit);
    if (soak.wrong)
        return bench_fail("%llu messages were lost or altered", (unsigned long long)soak.wrong);
    return soak.wrong_answers == 0 ||
           bench_fail("%llu values of OSC or knobs are not what they must be",
                      (unsigned long long)soak.wrong_answers);
}

int bench_midi_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "midi",
                                    .repeat_least = 1,
                                    .repeat_count = 5,
                                    .thorough_does = "ten minutes of soak, too"};
    double soak_s = 0;
    if (argc > 2 && !strcmp(argv[1], "--soak")) {
        char *end;
        soak_s = strtod(argv[2], &end);
        if (*end || !(soak_s >= 1 && soak_s <= 1e6)) {
            visible_say("lutetia bench midi: --soak must be 1..1000000 seconds (got \"%s\")",
                        argv[2]);
            return 2;
        }
        argc -= 2;
        argv += 2;
    }
    int status = bench_options_parse(&options, argc, argv);
    if (status >= 0)
        return status;
    bench_report_init(&report, "midi", 1, "a pseudo-terminal");
    bool ok = true;
    if (soak_s > 0) {
        ok = soak_add(&report, soak_s);
        return bench_options_finish(&options, &report, "server", ok);
    }
    ok = cases_measure(&report, options.repeat_count) &&
         midi_live_measure(&report, options.repeat_count);
    if (ok && options.thorough)
        ok = soak_add(&report, SOAK_S);
    return bench_options_finish(&options, &report, "server", ok);
}

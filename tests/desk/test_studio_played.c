/* test_studio_played.c - sessions that are played through the window: twenty deeds with
 * insertions and a change are what their script makes; what the journal has at any moment is
 * all that is older than a second; a full disk loses nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "../clock.h"
#include "../skip.h"
#include "sample.h"
#include "studio_played.h"
#include "studio_scene.h"
#include "xvfb.h"

enum { DEEDS = 20, MOMENTS = 20, JOURNAL_MOST = 1 << 20 };
#define LOST_MOST_S 1.5 /* a second between two syncs, and a busy machine's turn */
#define WAIT_S 150

/* ---- what is played ---- */

static const char *const tools[] = {"brush", "water", "wash", "drop", "blot"};

/* A deed from left to right, at `at_s`. */
static void deed_play(FILE *out, double at_s, const char *tool, int number)
{
    const double y = -30 + 7 * (number % 9), width = 6 + number % 5 * 4;
    fprintf(out, "%g set tool %s\n%g set width %g\n%g set pigment_%d 0.%d\n", at_s, tool, at_s,
            width, at_s, 1 + number % 2, 1 + number % 7);
    fprintf(out, "%g down %g %g 0.5\n", at_s, -40.0 + number, y);
    for (int k = 1; k < 6; k++)
        fprintf(out, "%g move %g %g 0.%d\n", at_s + 0.01 * k, -40.0 + number + 11 * k,
                y + k * (number % 4), 4 + k % 5);
    fprintf(out, "%g up %g %g 0.3\n", at_s + 0.06, 25.0 + number % 10, y + 12);
}

static void deeds_play(FILE *out)
{
    fprintf(out, "0 set paused on\n0 view 3 48 36 0 0\n");
    for (int i = 0; i < DEEDS; i++) {
        deed_play(out, 0.1 + 0.1 * i, tools[i % 5], i);
        fprintf(out, "%g step %d\n", 0.17 + 0.1 * i, 1 + i % 4);
    }
}

/* ---- the past ---- */

/* Two insertions of several deeds, a deed with another dish, one another way, one taken out:
 * the script has all of it as if it had been so from the beginning. */
static void session_is_its_script(void **state)
{
    (void)state;
    FILE *events = played_begin();
    deeds_play(events);
    fprintf(events, "3 picture %s\n3 moment 5\n", played_path("plain.png"));
    deed_play(events, 3.1, "brush", 31);
    deed_play(events, 3.2, "wash", 32);
    fprintf(events, "3.3 action present\n3.3 moment 14\n");
    deed_play(events, 3.4, "water", 33);
    deed_play(events, 3.5, "brush", 34);
    fprintf(events,
            "3.6 action present\n3.6 moment 9\n3.6 set pigment_1 1.2\n3.6 action dish\n");
    fprintf(events, "3.7 moment 1\n3.7 action way\n");
    deed_play(events, 3.7, "brush", 35);
    fprintf(events, "3.8 moment 18\n3.8 action remove\n3.9 moment 11\n");
    deed_play(events, 4, "drop", 36); /* the script ends this insertion */
    fprintf(events, "4.1 script %s\n4.1 picture %s\n4.2 save %s\n4.3 close\n",
            played_path("past.lua"), played_path("past.png"), played_path("past.h5"));
    fclose(events);
    played_run(NULL);
    assert_int_equal(played.status, 0);
    played_script_is("past.lua", "made/past.png", "past.png");
    char *with, *plain;
    const size_t count = played_file(played_path("past.png"), &with),
                 before = played_file(played_path("plain.png"), &plain);
    assert_true(count != before || memcmp(with, plain, count) != 0);
    free(with);
    free(plain);
    /* the saved sheet is the same, with all deeds: 20, 5 inserted, 1 taken out */
    struct studio_session *s;
    struct studio_deed *deeds;
    int deeds_count;
    assert_int_equal(studio_session_open(played_path("past.h5"), 64e6, &s), PAPER_OK);
    assert_int_equal(studio_session_deeds(s, &deeds, &deeds_count), PAPER_OK);
    assert_int_equal(deeds_count, DEEDS + 5 - 1);
    free(deeds);
    assert_int_equal(studio_session_picture(s, played_path("again.png"), 1), PAPER_OK);
    studio_session_destroy(s);
    played_files_same(played_path("again.png"), played_path("past.png"));
}

/* ---- killed at any moment ---- */

static double real_now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static const char *picture_path(int number)
{
    char name[32];
    snprintf(name, sizeof name, "deed-%d.png", number);
    return played_path(name);
}

/* How many deeds had been done so long before `now_s`: each writes a picture. */
static int deeds_before(double now_s)
{
    struct stat at;
    int count = 0;
    while (stat(picture_path(count + 1), &at) == 0 &&
           (double)at.st_mtim.tv_sec + 1e-9 * (double)at.st_mtim.tv_nsec < now_s)
        count++;
    return count;
}

struct snapshot {
    int older; /* deeds that it should have: a disk that is busy may write them later */
    int deeds; /* deeds that it has */
    size_t count;
    char *bytes;
};

/* What somebody who kills the studio now finds. False: there is no journal yet. */
static bool snapshot_take(struct snapshot *snapshot)
{
    char path[300];
    if (!played_journal(path, sizeof path))
        return false;
    snapshot->older = deeds_before(real_now_s() - LOST_MOST_S);
    snapshot->count = played_file(path, &snapshot->bytes);
    return true;
}

/* What it has is as it was: before its last deed, whose steps may not be written yet. */
static void snapshot_is_whole(struct snapshot *snapshot)
{
    const char *path = played_path("killed.journal");
    struct paper_journal_found found;
    struct studio_session *s;
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(snapshot->bytes, 1, snapshot->count, out), snapshot->count);
    assert_int_equal(fclose(out), 0);
    assert_int_equal(studio_session_find(path, NULL, 64e6, &found, &s), PAPER_OK);
    snapshot->deeds = studio_session_deeds_done(s);
    if (snapshot->deeds > 1) {
        assert_int_equal(studio_session_visit(s, snapshot->deeds - 1), PAPER_OK);
        assert_int_equal(studio_session_picture(s, played_path("killed.png"), 1), PAPER_OK);
        played_files_same(played_path("killed.png"), picture_path(snapshot->deeds - 1));
    }
    studio_session_destroy(s);
}

/* Takes snapshots until all deeds are older than what may be lost; the last ones are kept. */
static void snapshots_take(struct snapshot snapshots[MOMENTS])
{
    const double until_s = clock_now_s() + WAIT_S;
    uint64_t chance = 5;
    int taken = 0;
    while (taken < MOMENTS && clock_now_s() < until_s) {
        usleep((useconds_t)(50000 + sample_word(&chance) % 700000));
        if (snapshot_take(&snapshots[taken]))
            taken++;
        if (taken == MOMENTS && deeds_before(real_now_s() - LOST_MOST_S) < DEEDS) {
            free(snapshots[0].bytes);
            memmove(&snapshots[0], &snapshots[1], (MOMENTS - 1) * sizeof *snapshots);
            taken--;
        }
    }
    assert_int_equal(taken, MOMENTS);
}

/* All deeds get there, however busy the disk is. */
static void last_snapshot_has_all(struct snapshot *last)
{
    const double until_s = clock_now_s() + WAIT_S;
    do {
        usleep(100000);
        assert_true(snapshot_take(last));
        snapshot_is_whole(last);
        free(last->bytes);
    } while (last->deeds < DEEDS && clock_now_s() < until_s);
    assert_int_equal(last->deeds, DEEDS);
}

/* Deeds, each with a picture after it. */
static pid_t pictured_start(void)
{
    FILE *events = played_begin();
    fprintf(events, "0 set paused on\n0 view 3 48 36 0 0\n");
    for (int i = 0; i < DEEDS; i++) {
        deed_play(events, 0.1 + 0.3 * i, tools[i % 5], i);
        fprintf(events, "%g step 2\n%g picture %s\n", 0.17 + 0.3 * i, 0.18 + 0.3 * i,
                picture_path(i + 1));
    }
    fclose(events);
    return played_start();
}

static void killed_at_random_moments(void **state)
{
    (void)state;
    struct snapshot snapshots[MOMENTS], last;
    int in_time = 0;
    const pid_t studio = pictured_start();
    snapshots_take(snapshots);
    last_snapshot_has_all(&last);
    kill(studio, SIGKILL);
    waitpid(studio, NULL, 0);
    for (int i = 0; i < MOMENTS; i++) {
        snapshot_is_whole(&snapshots[i]);
        free(snapshots[i].bytes);
        in_time += snapshots[i].deeds >= snapshots[i].older;
        assert_true(i == 0 || snapshots[i].deeds >= snapshots[i - 1].deeds);
    }
    if (in_time < MOMENTS / 2)
        fail_msg("%d of %d journals had all that was older than %g s", in_time, MOMENTS,
                 LOST_MOST_S);
    char path[300];
    if (played_journal(path, sizeof path))
        unlink(path);
}

/* Opened again by the window, without a name, it is what its journal has. */
static void window_finds_it(void)
{
    struct paper_journal_found found;
    struct studio_session *s;
    FILE *events = played_begin();
    fprintf(events, "0.5 picture %s\n0.6 close\n", played_path("found.png"));
    fclose(events);
    assert_int_equal(studio_session_find(played_path("killed.journal"), NULL, 64e6, &found, &s),
                     PAPER_OK);
    assert_int_equal(studio_session_picture(s, played_path("journal.png"), 1), PAPER_OK);
    studio_session_destroy(s);
    played_again();
    assert_int_equal(played.status, 0);
    played_files_same(played_path("found.png"), played_path("journal.png"));
}

/* A studio that is killed, not a journal that is copied; it takes minutes. */
static void killed_twenty_times(void **state)
{
    const char *full = getenv("PAPER_TEST_FULL");
    uint64_t chance = 11;
    int in_time = 0;
    (void)state;
    if (!full || *full != '1')
        skip_because("it takes minutes; PAPER_TEST_FULL=1 asks for it");
    for (int i = 0; i < MOMENTS; i++) {
        struct snapshot snapshot = {0};
        char path[300];
        for (int k = 1; k <= DEEDS; k++)
            unlink(picture_path(k));
        const pid_t studio = pictured_start();
        /* the first deed takes long on a busy machine: three of four are killed after it */
        while (!played_journal(path, sizeof path) ||
               (i % 4 && access(picture_path(i % 4), F_OK) != 0))
            usleep(10000);
        usleep((useconds_t)(sample_word(&chance) % 7000000));
        const double killed_s = real_now_s();
        kill(studio, SIGKILL);
        waitpid(studio, NULL, 0);
        assert_true(snapshot_take(&snapshot));
        snapshot.older = deeds_before(killed_s - LOST_MOST_S);
        snapshot_is_whole(&snapshot);
        window_finds_it();
        print_message("killed %d: %d deeds seen, %d of them over %g s before, %d found\n",
                      i + 1, deeds_before(killed_s), snapshot.older, LOST_MOST_S,
                      snapshot.deeds);
        in_time += snapshot.deeds >= snapshot.older;
        free(snapshot.bytes);
        while (played_journal(path, sizeof path))
            unlink(path);
    }
    assert_int_equal(in_time, MOMENTS);
}

/* ---- a full disk ---- */

static bool wait_for(const char *path)
{
    const double until_s = clock_now_s() + WAIT_S;
    while (access(path, R_OK) != 0 && clock_now_s() < until_s)
        usleep(2000);
    return access(path, R_OK) == 0;
}

/* From some moment on no file may grow: the file of before stays, nothing is left in part, and
 * the window closes as ever. */
static void full_disk_loses_nothing(void **state)
{
    (void)state;
    const struct rlimit full = {0, 0};
    char *before, *after;
    int status;
    const char *kept = played_path("kept.h5"), *none = played_path("none.png");
    FILE *events = played_begin();
    fprintf(events, "0 set paused on\n");
    deed_play(events, 0.1, "brush", 3);
    fprintf(events, "0.3 save %s\n0.4 picture %s\n", kept, played_path("ready.png"));
    fprintf(events, "15 save %s\n15 picture %s\n15.5 close\n", kept, none);
    fclose(events);
    const pid_t studio = played_start();
    assert_true(wait_for(played_path("ready.png")));
    assert_int_equal(prlimit(studio, RLIMIT_FSIZE, &full, NULL), 0);
    const size_t count = played_file(kept, &before);
    assert_int_equal(waitpid(studio, &status, 0), studio);
    assert_int_equal(played_file(kept, &after), count);
    assert_memory_equal(before, after, count);
    assert_int_not_equal(access(none, F_OK), 0);
    assert_true(WIFEXITED(status));
    free(before);
    free(after);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(session_is_its_script),
        cmocka_unit_test(killed_at_random_moments),
        cmocka_unit_test(killed_twenty_times),
        cmocka_unit_test(full_disk_loses_nothing),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, played_folder_make, played_folder_remove);
}

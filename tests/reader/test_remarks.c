/* test_remarks.c - what readers leave in a document: kept, found again, erased and had back; a
 * killed program has lost nothing; what is no file of remarks, or a damaged one, is left as it
 * is. */
#include <reader_remarks.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <math.h>
#include <signal.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../sample.h"
#include "kept.h"

static struct reader_remark typed(const char *words)
{
    static char kept[100];
    snprintf(kept, sizeof kept, "%s", words);
    return (struct reader_remark){
        .kind = READER_REMARK_TYPED, .text = kept, .rgba = 0xffee00ff};
}

/* ---- keeping ---- */

static void remarks_are_kept(void **state)
{
    (void)state;
    struct reader_ink_point points[200];
    for (int i = 0; i < 200; i++)
        points[i] =
            (struct reader_ink_point){(float)i / 7, sinf((float)i), 0.5f, (float)i * 0.005f};
    const struct reader_remark ink = {.kind = READER_REMARK_INK,
                                      .rgba = 0x2060c0b0,
                                      .width = 0.25,
                                      .points = points,
                                      .points_count = 200};
    struct reader_remark words = typed("who says so?");
    struct reader_remarks *remarks = kept_open(kept_text);
    assert_int_equal(access(kept_path, F_OK), -1); /* nothing was written yet */
    kept_add(remarks, &words, "bridge held");
    kept_add(remarks, &ink, "marsh");
    assert_int_equal(kept_move(remarks, 1, 2.5, -1), READER_OK);
    assert_int_equal(reader_remarks_write(remarks, 0, "the engineer"), READER_OK);
    assert_int_equal(reader_remarks_erase(remarks, 0, true), READER_OK);
    assert_int_equal(reader_remarks_sync(remarks), READER_OK);
    reader_remarks_close(remarks);

    remarks = kept_open(kept_text);
    assert_int_equal(reader_remarks_count(remarks), 2);
    const struct reader_remark *r = reader_remarks_get(remarks, 0);
    assert_string_equal(r->text, "the engineer");
    assert_true(r->gone_s >= r->made_s && r->made_s > 1e9);
    kept_quotation_is(r, "bridge held");
    assert_string_equal(reader_anchor_headings(r->anchor), "The town");
    r = reader_remarks_get(remarks, 1);
    assert_int_equal(r->kind, READER_REMARK_INK);
    assert_int_equal(r->points_count, 200);
    assert_memory_equal(r->points, points, sizeof points);
    assert_true(r->x == 2.5 && r->y == -1 && r->width == 0.25 && r->rgba == 0x2060c0b0);
    assert_int_equal(reader_remarks_erase(remarks, 0, false), READER_OK);
    reader_remarks_close(remarks);
    remarks = kept_open(kept_text);
    assert_true(reader_remarks_get(remarks, 0)->gone_s == 0);
    reader_remarks_close(remarks);
}

/* Strokes are played in the order in which they were drawn: pieces that were kept later at
 * their own times, what is drawn while something else is at its distance from that; long pauses
 * are short ones. */
static void ink_is_played_in_order(void **state)
{
    (void)state;
    enum { STROKES = 7 };
    static const struct {
        double begins_s, lasts_s, played_s; /* played: -1: it is not */
        bool gone;
        double played_all_s;                      /* with what is erased */
    } strokes[STROKES] = {{1000, 4, -1, true, 0}, /* cut into the two at the end */
                          {1004.25, 1, 2.65, false, 4.25}, {2000, 2, 4.05, false, 5.65},
                          {2001, 0.5, 5.05, false, 6.65}, /* within that */
                          {2002, 1, 6.05, false, 7.65},    {1000, 1, 0, false, 0},
                          {1003, 1, 1.4, false, 3}};
    static const double all_s[2] = {7.05, 8.65};
    struct reader_remarks *remarks = kept_open(kept_text);
    for (int i = 0; i < STROKES; i++) {
        struct reader_ink_point points[2] = {{0, 0, 1, 0},
                                             {1, 1, 1, (float)strokes[i].lasts_s}};
        const struct reader_remark ink = {.kind = READER_REMARK_INK,
                                          .made_s = strokes[i].begins_s + strokes[i].lasts_s,
                                          .points = points,
                                          .points_count = 2};
        assert_int_equal(kept_add(remarks, &ink, "marsh"), i);
        if (strokes[i].gone)
            assert_int_equal(reader_remarks_erase(remarks, i, true), READER_OK);
    }
    struct reader_remark words = typed("why?");
    kept_add(remarks, &words, "river");
    for (int kept = 0; kept < 2; kept++) {
        for (int erased = 0; erased < 2; erased++) {
            struct reader_played played[STROKES + 1];
            int count;
            const double lasts_s = reader_remarks_play(remarks, erased, played, &count);
            assert_int_equal(count, erased ? STROKES : STROKES - 1);
            assert_true(fabs(lasts_s - all_s[erased]) < 1e-6);
            for (int i = 0; i < count; i++) {
                const int index = played[i].index;
                const double begins_s =
                    erased ? strokes[index].played_all_s : strokes[index].played_s;
                if (fabs(played[i].begins_s - begins_s) > 1e-6)
                    fail_msg("stroke %d begins at %g and not at %g", index, played[i].begins_s,
                             begins_s);
                assert_true(i == 0 || played[i].begins_s >= played[i - 1].begins_s);
            }
        }
        reader_remarks_close(remarks); /* and the file has those times */
        remarks = kept_open(kept_text);
    }
    reader_remarks_close(remarks);
}

/* ---- layers ---- */

/* Two readers: each changes only what is its own; what is hidden is not to be shown. */
static void layers_are_kept(void **state)
{
    (void)state;
    const struct reader_ink_point dot = {1, 1, 0.5f, 0};
    const struct reader_remark ink = {.kind = READER_REMARK_INK,
                                      .width = 0.2,
                                      .rgba = 0x2060c0b0,
                                      .points = (struct reader_ink_point *)(uintptr_t)&dot,
                                      .points_count = 1};
    struct reader_remark words = typed("first");
    struct reader_remarks *remarks = kept_open(kept_text);
    struct reader_played played[4];
    int anna, ben, count;
    assert_int_equal(reader_remarks_layers(remarks), 1);
    kept_add(remarks, &words, "marsh");
    assert_int_equal(reader_remarks_layer_add(remarks, "Anna Ö.", &anna), READER_OK);
    assert_int_equal(reader_remarks_layer_add(remarks, "Ben", &ben), READER_OK);
    assert_int_equal(reader_remarks_layer_add(remarks, "Anna Ö.", &count), READER_OK);
    assert_true(anna == 1 && ben == 2 && count == 1);
    reader_remarks_write_layer(remarks, anna);
    kept_add(remarks, &ink, "river");
    assert_int_equal(reader_remarks_erase(remarks, 0, true), READER_BAD_ARGUMENT);
    assert_non_null(strstr(reader_error(), "the layer that has no name"));
    assert_int_equal(kept_move(remarks, 1, 3, 4), READER_OK);
    reader_remarks_close(remarks);

    remarks = kept_open(kept_text);
    assert_int_equal(reader_remarks_layers(remarks), 3);
    assert_string_equal(reader_remarks_layer(remarks, 1), "Anna Ö.");
    assert_string_equal(reader_remarks_layer(remarks, 7), "");
    assert_string_equal(reader_remarks_get(remarks, 0)->by, "");
    assert_string_equal(reader_remarks_get(remarks, 1)->by, "Anna Ö.");
    assert_true(reader_remarks_get(remarks, 1)->x == 3);
    assert_int_equal(kept_move(remarks, 1, 0, 0), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_erase(remarks, 0, true), READER_OK);
    assert_int_equal(reader_remarks_erase(remarks, 0, false), READER_OK);
    reader_remarks_play(remarks, false, played, &count);
    assert_int_equal(count, 1);
    reader_remarks_layer_show(remarks, anna, false);
    assert_false(reader_remark_seen(reader_remarks_get(remarks, 1)));
    assert_true(reader_remark_seen(reader_remarks_get(remarks, 0)));
    reader_remarks_play(remarks, true, played, &count);
    assert_int_equal(count, 0);
    reader_remarks_write_layer(remarks, anna); /* is shown, then */
    assert_true(reader_remark_seen(reader_remarks_get(remarks, 1)));
    assert_int_equal(reader_remarks_written(remarks), anna);
    assert_int_equal(reader_remarks_layer_add(remarks, "", &count), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_layer_add(remarks, "a\nb", &count), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_layer_add(remarks, "\xc3", &count), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_layer_add(remarks, "\xc2\x9b", &count),
                     READER_BAD_ARGUMENT);
    for (int i = 3; i <= READER_LAYERS_MAX; i++) {
        char name[20];
        snprintf(name, sizeof name, "reader %d", i);
        assert_int_equal(reader_remarks_layer_add(remarks, name, &count),
                         i < READER_LAYERS_MAX ? READER_OK : READER_TOO_LARGE);
    }
    reader_remarks_close(remarks);
}

static void wrong_remarks_are_refused(void **state)
{
    (void)state;
    struct reader_remarks *remarks = kept_open(kept_text);
    struct reader_remark what = typed("x");
    int index;
    assert_int_equal(reader_remarks_add(remarks, &what, kept_text, 10, 5, 11, &index),
                     READER_BAD_ARGUMENT);
    what.kind = READER_REMARK_INK;
    assert_int_equal(reader_remarks_add(remarks, &what, kept_text, 10, 5, 7, &index),
                     READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_erase(remarks, 0, true), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_write(remarks, -1, "a"), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_count(remarks), 0);
    reader_remarks_close(remarks);
}

/* ---- a text that has changed ---- */

static void remarks_follow_the_text(void **state)
{
    (void)state;
    struct reader_remark words = typed("a");
    struct reader_remarks *remarks = kept_open(kept_text);
    kept_add(remarks, &words, "bridge held");
    kept_add(remarks, &words, "Before it was a town it was");
    reader_remarks_close(remarks);
    char changed[400];
    snprintf(changed, sizeof changed, "More before it.\n\n%s", kept_text);
    remarks = kept_open(changed);
    const struct reader_remark *r = reader_remarks_get(remarks, 0);
    assert_false(r->orphan);
    assert_memory_equal(changed + r->begin, "bridge held", 11);
    reader_remarks_close(remarks);
    /* The second change is found from the first: the anchor was kept anew. */
    snprintf(
        changed, sizeof changed,
        "Even more.\n\nMore before it.\n\n# The town\n\nIt was a town before long. The river "
        "ran slowly, and the bridge held.\n\n");
    remarks = kept_open(changed);
    r = reader_remarks_get(remarks, 0);
    assert_false(r->orphan);
    assert_memory_equal(changed + r->begin, "bridge held", 11);
    r = reader_remarks_get(remarks, 1);
    assert_true(r->orphan);
    kept_quotation_is(r, "Before it was a town it was");
    reader_remarks_close(remarks);
    /* And the text is back. */
    remarks = kept_open(kept_text);
    assert_false(reader_remarks_get(remarks, 1)->orphan);
    reader_remarks_close(remarks);
}

/* ---- killed ---- */

/* A program that is killed at any moment has lost nothing that it was told is kept. */
static void killed_has_lost_nothing(void **state)
{
    (void)state;
    uint64_t random = 5;
    int told = 0;
    for (int turn = 0; turn < 12; turn++) {
        int pipes[2];
        char one;
        assert_int_equal(pipe(pipes), 0);
        const pid_t child = fork();
        if (child == 0) {
            struct reader_remarks *remarks;
            struct reader_remark words = typed("kept");
            int index;
            if (reader_remarks_open(kept_path, &remarks) != READER_OK)
                _exit(1);
            while (reader_remarks_add(remarks, &words, kept_text, strlen(kept_text), 20, 30,
                                      &index) == READER_OK &&
                   write(pipes[1], "x", 1) == 1)
                ;
            _exit(1);
        }
        close(pipes[1]);
        for (int n = 1 + (int)(sample_word(&random) % 40);
             n > 0 && read(pipes[0], &one, 1) == 1; n--)
            told++;
        usleep((useconds_t)(sample_word(&random) % 2000));
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        while (read(pipes[0], &one, 1) == 1)
            told++;
        close(pipes[0]);
        struct reader_remarks *remarks = kept_open(kept_text);
        /* one may have been kept before it could be told */
        assert_true(reader_remarks_count(remarks) >= told);
        assert_true(reader_remarks_count(remarks) <= told + turn + 1);
        reader_remarks_close(remarks);
    }
}

/* ---- files that are wrong ---- */

static void valid_make(int count)
{
    struct reader_remarks *remarks = kept_open(kept_text);
    struct reader_remark words = typed("a remark");
    for (int i = 0; i < count; i++)
        kept_add(remarks, &words, i % 2 ? "bridge held" : "river");
    reader_remarks_close(remarks);
}

static void foreign_files_are_left(void **state)
{
    (void)state;
    kept_write("this is no file of notes, but a letter", 38);
    kept_is_refused("not a database");
    unlink(kept_path);
    kept_sql("CREATE TABLE birds(name TEXT); INSERT INTO birds VALUES('heron')");
    kept_is_refused("another program's");
    unlink(kept_path);
    valid_make(3);
    kept_sql("PRAGMA user_version=5");
    kept_is_refused("newer version");
    for (int version = 2; version <= 4; version++) { /* without its tables */
        char sql[40];
        unlink(kept_path);
        valid_make(3);
        snprintf(sql, sizeof sql, "PRAGMA user_version=%d", version);
        kept_sql(sql);
        kept_is_refused("not as notes are");
    }
    unlink(kept_path);
    valid_make(3);
    kept_sql("CREATE TRIGGER t AFTER UPDATE ON remark BEGIN DELETE FROM remark; END");
    kept_is_refused("not as notes are");
    unlink(kept_path);
    valid_make(3);
    kept_sql("UPDATE remark SET width=1e300 WHERE id=2");
    kept_is_refused("damaged");
    unlink(kept_path);
    valid_make(3);
    kept_sql("UPDATE remark SET anchor=x'00' WHERE id=2");
    kept_is_refused("damaged");
    unlink(kept_path);
    assert_int_equal(mkdir(kept_path, 0700), 0);
    struct reader_remarks *remarks;
    assert_int_equal(reader_remarks_open(kept_path, &remarks), READER_FAILED);
    rmdir(kept_path);
}

/* A file cut off or with damaged bytes is refused, or what it has is whole. */
static void damaged_files_are_left(void **state)
{
    (void)state;
    uint64_t random = 9;
    size_t count;
    int refused = 0;
    valid_make(30);
    char *whole = kept_read(&count), *bytes = malloc(count);
    assert_non_null(bytes);
    for (int turn = 0; turn < 300; turn++) {
        struct reader_remarks *remarks;
        memcpy(bytes, whole, count);
        size_t length = turn % 3 ? count : (size_t)(sample_word(&random) % count);
        for (int k = 0; turn % 3 && k < 1 + turn % 5; k++)
            bytes[sample_word(&random) % count] = (char)sample_word(&random);
        kept_write(bytes, length);
        if (reader_remarks_open(kept_path, &remarks) == READER_OK) {
            assert_true(length == 0 || reader_remarks_count(remarks) <= 30);
            reader_remarks_find(remarks, kept_text, strlen(kept_text));
            reader_remarks_close(remarks);
        } else {
            assert_non_null(strstr(reader_error(), kept_path));
            refused++;
        }
        char other[120];
        snprintf(other, sizeof other, "%s-wal", kept_path);
        unlink(other);
        snprintf(other, sizeof other, "%s-shm", kept_path);
        unlink(other);
    }
    assert_true(refused > 100);
    free(whole);
    free(bytes);
}

/* A folder that cannot be written to. */
/* Layers that are not as layers are. */
static void damaged_layers_are_left(void **state)
{
    static const char *const harms[] = {"UPDATE layer SET id=3 WHERE id=2",
                                        "UPDATE layer SET name=''",
                                        "UPDATE layer SET name=x'0a'",
                                        "UPDATE in_layer SET layer=9",
                                        "UPDATE in_layer SET layer=-1",
                                        "DELETE FROM layer WHERE id=1",
                                        "UPDATE layer SET name='a' || char(27) || 'b'"};
    (void)state;
    for (size_t i = 0; i < sizeof harms / sizeof *harms; i++) {
        int layer;
        struct reader_remark words = typed("hers");
        struct reader_remarks *remarks = kept_open(kept_text);
        assert_int_equal(reader_remarks_layer_add(remarks, "Anna", &layer), READER_OK);
        assert_int_equal(reader_remarks_layer_add(remarks, "Ben", &layer), READER_OK);
        reader_remarks_write_layer(remarks, layer);
        kept_add(remarks, &words, "marsh");
        reader_remarks_close(remarks);
        kept_sql(harms[i]);
        kept_is_refused("damaged");
        unlink(kept_path);
    }
}

static void folder_missing(void **state)
{
    (void)state;
    struct reader_remarks *remarks;
    struct reader_remark words = typed("x");
    int index;
    assert_int_equal(reader_remarks_open("/proc/none/marsh.md.notes", &remarks), READER_OK);
    assert_int_equal(
        reader_remarks_add(remarks, &words, kept_text, strlen(kept_text), 20, 30, &index),
        READER_FAILED);
    assert_non_null(strstr(reader_error(), "/proc/none/marsh.md.notes"));
    assert_int_equal(reader_remarks_count(remarks), 0);
    reader_remarks_close(remarks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(remarks_are_kept, kept_begin),
        cmocka_unit_test_setup(layers_are_kept, kept_begin),
        cmocka_unit_test_setup(ink_is_played_in_order, kept_begin),
        cmocka_unit_test_setup(wrong_remarks_are_refused, kept_begin),
        cmocka_unit_test_setup(remarks_follow_the_text, kept_begin),
        cmocka_unit_test_setup(killed_has_lost_nothing, kept_begin),
        cmocka_unit_test_setup(foreign_files_are_left, kept_begin),
        cmocka_unit_test_setup(damaged_files_are_left, kept_begin),
        cmocka_unit_test_setup(damaged_layers_are_left, kept_begin),
        cmocka_unit_test_setup(folder_missing, kept_begin),
    };
    return kept_all(tests, sizeof tests / sizeof *tests);
}

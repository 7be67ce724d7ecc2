/* test_arranged.c - ink that is scaled and grouped, as it is kept; and several programs that
 * write one file of remarks. */
#include "kept.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- arranging ---- */

static struct reader_ink_point line[] = {{0, 0, 1, 0}, {2, 1, 1, 0.5f}};
static const struct reader_remark lined = {.kind = READER_REMARK_INK,
                                           .rgba = 0x2060c0b0,
                                           .width = 0.25,
                                           .points = line,
                                           .points_count = 2};

static bool is_same(const struct reader_arranged *a, const struct reader_arranged *b)
{
    return a->index == b->index && a->x == b->x && a->y == b->y && a->scale_x == b->scale_x &&
           a->scale_y == b->scale_y && a->hangs == b->hangs && a->group == b->group &&
           a->around == b->around;
}

static long long version_now(void)
{
    sqlite3 *db;
    sqlite3_stmt *s;
    assert_int_equal(sqlite3_open(kept_path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(db, "PRAGMA user_version", -1, &s, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(s), SQLITE_ROW);
    const long long version = sqlite3_column_int64(s, 0);
    sqlite3_finalize(s);
    sqlite3_close(db);
    return version;
}

/* Scaled, grouped, and both undone; a file in which ink is only moved stays what it was. */
static void ink_is_arranged(void **state)
{
    (void)state;
    struct reader_remarks *remarks = kept_open(kept_text);
    kept_add(remarks, &lined, "marsh");
    kept_add(remarks, &lined, "bridge");
    char who[] = "who?";
    const struct reader_remark words = {.kind = READER_REMARK_TYPED, .text = who};
    kept_add(remarks, &words, "bridge held");
    assert_int_equal(kept_move(remarks, 0, 1, 2), READER_OK);
    reader_remarks_close(remarks);
    assert_int_equal(version_now(), 1);

    remarks = kept_open(kept_text);
    struct reader_arranged before[2], to[2];
    for (int i = 0; i < 2; i++)
        to[i] = before[i] = reader_remarks_arranged(remarks, i);
    to[0].scale_x = 3;
    to[0].scale_y = 0.75;
    to[0].group = to[1].group = to[1].hangs = 0;
    to[1].x = 40;
    assert_int_equal(reader_remarks_arrange(remarks, to, 2), READER_OK);
    struct reader_ink_place place = reader_ink_place(reader_remarks_get(remarks, 0), 1);
    assert_true(place.x == 6 && place.y == 0.75 && place.width == 1.5 * 0.25);
    reader_remarks_close(remarks);
    assert_int_equal(version_now(), 3);

    remarks = kept_open(kept_text);
    for (int i = 0; i < 2; i++) {
        const struct reader_arranged now = reader_remarks_arranged(remarks, i);
        assert_true(is_same(&now, &to[i]));
        kept_quotation_is(reader_remarks_get(remarks, i), "marsh"); /* both hang on it */
        assert_memory_equal(kept_text + reader_remarks_get(remarks, i)->begin, "marsh", 5);
    }
    to[0].scale_x = 0.001; /* one cannot be: none is */
    to[1].scale_x = 2;
    const struct reader_arranged wrong[2] = {to[1], to[0]};
    assert_int_equal(reader_remarks_arrange(remarks, wrong, 2), READER_BAD_ARGUMENT);
    assert_true(reader_remarks_get(remarks, 1)->scale_x == 1);
    to[0] = reader_remarks_arranged(remarks, 2);
    assert_int_equal(reader_remarks_arrange(remarks, to, 1), READER_BAD_ARGUMENT); /* no ink */
    assert_int_equal(kept_move(remarks, 0, NAN, 0), READER_BAD_ARGUMENT);
    to[0] = reader_remarks_arranged(remarks, 0);
    to[0].hangs = 3;
    assert_int_equal(reader_remarks_arrange(remarks, to, 1), READER_BAD_ARGUMENT);
    assert_int_equal(reader_remarks_arrange(remarks, before, 2), READER_OK);
    reader_remarks_close(remarks);
    remarks = kept_open(kept_text);
    for (int i = 0; i < 2; i++) {
        const struct reader_arranged now = reader_remarks_arranged(remarks, i);
        assert_true(is_same(&now, &before[i]));
    }
    kept_quotation_is(reader_remarks_get(remarks, 1), "bridge");
    reader_remarks_close(remarks);
}

/* What hangs on another's anchor goes with it when the text is edited, is gone when that is,
 * and has its own still. */
static void groups_go_with_their_anchor(void **state)
{
    (void)state;
    struct reader_remarks *remarks = kept_open(kept_text);
    kept_add(remarks, &lined, "marsh");
    kept_add(remarks, &lined, "bridge");
    struct reader_arranged to[2];
    for (int i = 0; i < 2; i++) {
        to[i] = reader_remarks_arranged(remarks, i);
        to[i].hangs = to[i].group = 1;
    }
    assert_int_equal(reader_remarks_arrange(remarks, to, 2), READER_OK);
    const struct reader_remark *r = reader_remarks_get(remarks, 0);
    const size_t bridge = (size_t)(strstr(kept_text, "bridge") - kept_text);
    assert_int_equal(r->begin, bridge);
    reader_remarks_edit(remarks, 0, 0, 7);
    assert_int_equal(r->begin, bridge + 7);
    const struct reader_remark_place place = reader_remarks_place_of(remarks, 1);
    reader_remarks_edit(remarks, bridge + 7, 6, 0);
    assert_true(r->orphan && !reader_remarks_place_of(remarks, 0).orphan);
    reader_remarks_place(remarks, &place, 1);
    assert_true(!r->orphan && r->begin == bridge + 7);
    reader_remarks_close(remarks);
    /* the words are there no longer */
    char other[300];
    memcpy(other, kept_text, strlen(kept_text) + 1);
    memcpy(strstr(other, "bridge"), "column", 6);
    remarks = kept_open(other);
    assert_true(reader_remarks_get(remarks, 0)->orphan);
    to[0] = reader_remarks_arranged(remarks, 0);
    to[0].hangs = 0;
    assert_int_equal(reader_remarks_arrange(remarks, to, 1), READER_OK);
    assert_false(reader_remarks_get(remarks, 0)->orphan);
    reader_remarks_close(remarks);
}

/* ---- two programs ---- */

/* Each of several programs adds a layer of its own to one file at the same time, and a stroke
 * to that: all are there, none was told of SQLite. */
static void layers_are_made_at_once(void **state)
{
    enum { PROGRAMS = 5 };
    pid_t children[PROGRAMS];
    int pipes[2];
    char begin_now[PROGRAMS] = "";
    (void)state;
    assert_int_equal(pipe(pipes), 0);
    for (int i = 0; i < PROGRAMS; i++) {
        children[i] = fork();
        if (children[i] == 0) {
            char name[20], one;
            int layer, index;
            struct reader_remarks *remarks;
            snprintf(name, sizeof name, "Reader %d", i % 4); /* two have one name */
            if (reader_remarks_open(kept_path, &remarks) != READER_OK ||
                read(pipes[0], &one, 1) != 1 ||
                reader_remarks_layer_add(remarks, name, &layer) != READER_OK)
                _exit(1);
            reader_remarks_write_layer(remarks, layer);
            if (reader_remarks_add(remarks, &lined, kept_text, strlen(kept_text), 20, 30,
                                   &index) != READER_OK ||
                strcmp(reader_remarks_layer(remarks, layer), name) != 0)
                _exit(2);
            reader_remarks_close(remarks);
            _exit(0);
        }
    }
    usleep(20000);
    assert_int_equal(write(pipes[1], begin_now, PROGRAMS), PROGRAMS);
    for (int i = 0; i < PROGRAMS; i++) {
        int status = 0;
        waitpid(children[i], &status, 0);
        assert_int_equal(status, 0);
    }
    close(pipes[0]);
    close(pipes[1]);
    struct reader_remarks *remarks = kept_open(kept_text);
    assert_int_equal(reader_remarks_layers(remarks), 5);
    assert_int_equal(reader_remarks_count(remarks), PROGRAMS);
    int in_layer[5] = {0};
    for (int i = 0; i < PROGRAMS; i++)
        in_layer[reader_remarks_get(remarks, i)->layer]++;
    assert_int_equal(in_layer[0], 0);
    for (int i = 1; i < 5; i++)
        assert_int_equal(in_layer[i],
                         strcmp(reader_remarks_layer(remarks, i), "Reader 0") == 0 ? 2 : 1);
    reader_remarks_close(remarks);
}

/* A program that does not end its change is told of in words of our own. */
static void busy_files_are_said(void **state)
{
    (void)state;
    struct reader_remarks *remarks = kept_open(kept_text);
    sqlite3 *db;
    int layer;
    kept_add(remarks, &lined, "marsh");
    assert_int_equal(sqlite3_open(kept_path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, "BEGIN IMMEDIATE", NULL, NULL, NULL), SQLITE_OK);
    assert_int_equal(reader_remarks_layer_add(remarks, "Anna", &layer), READER_FAILED);
    assert_non_null(strstr(reader_error(), "another program has been writing it"));
    assert_int_equal(reader_remarks_layers(remarks), 1);
    sqlite3_exec(db, "ROLLBACK", NULL, NULL, NULL);
    sqlite3_close(db);
    assert_int_equal(reader_remarks_layer_add(remarks, "Anna", &layer), READER_OK);
    reader_remarks_close(remarks);
}

static void damaged_arrangements_are_left(void **state)
{
    static const char *const harms[] = {
        "UPDATE arranged SET scale_x=0",      "UPDATE arranged SET scale_y=1e9",
        "UPDATE arranged SET scale_x=-1",     "UPDATE arranged SET hangs=7",
        "UPDATE arranged SET hangs=0",        "UPDATE arranged SET grouped=7",
        "UPDATE arranged SET scale_x='wide'", "UPDATE arranged SET grouped=-1"};
    (void)state;
    for (size_t i = 0; i < sizeof harms / sizeof *harms; i++) {
        struct reader_remarks *remarks = kept_open(kept_text);
        kept_add(remarks, &lined, "marsh");
        struct reader_arranged to = reader_remarks_arranged(remarks, 0);
        to.scale_x = 2;
        assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
        reader_remarks_close(remarks);
        kept_sql(harms[i]);
        kept_is_refused("damaged");
        unlink(kept_path);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(ink_is_arranged, kept_begin),
        cmocka_unit_test_setup(groups_go_with_their_anchor, kept_begin),
        cmocka_unit_test_setup(damaged_arrangements_are_left, kept_begin),
        cmocka_unit_test_setup(layers_are_made_at_once, kept_begin),
        cmocka_unit_test_setup(busy_files_are_said, kept_begin),
    };
    return kept_all(tests, sizeof tests / sizeof *tests);
}

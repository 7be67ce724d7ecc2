/* test_around.c - ink that text flows around: kept and had back, as obstacles, in groups;
 * what a file of remarks says that is damaged or beyond all measure. */
#include "kept.h"

#include <reader_around.h>
#include <reader_document.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static struct reader_document *document;

static void document_open(void)
{
    assert_int_equal(reader_document_create(&document), READER_OK);
    assert_int_equal(reader_document_add(document, kept_text, strlen(kept_text)), READER_OK);
    assert_int_equal(reader_document_plain(document), READER_OK);
}

/* The file's remarks, found in the document. */
static struct reader_remarks *remarks_open(void)
{
    return kept_open(document->plain);
}

/* A stroke that text flows around, through those points, at the first place of what is
 * quoted. */
static int ink_add(struct reader_remarks *remarks, struct reader_ink_point *points, int count,
                   const char *quotation)
{
    const struct reader_remark ink = {.kind = READER_REMARK_INK,
                                      .rgba = 0x2060c0b0,
                                      .width = 0.2,
                                      .points = points,
                                      .points_count = count};
    const size_t begin = (size_t)(strstr(document->plain, quotation) - document->plain);
    int index;
    assert_int_equal(reader_remarks_add(remarks, &ink, document->plain, strlen(document->plain),
                                        begin, begin + strlen(quotation), &index),
                     READER_OK);
    struct reader_arranged to = reader_remarks_arranged(remarks, index);
    to.around = READER_AROUND_RIGHT;
    assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
    return index;
}

/* How many there are; the caller frees *out. */
static int obstacles_find(const struct reader_remarks *remarks, struct reader_obstacle **out)
{
    int count;
    assert_int_equal(reader_around_find(remarks, document, out, &count), READER_OK);
    return count;
}

static struct reader_ink_point across[] = {{0, 0, 1, 0}, {4, 0, 1, 0.5f}, {4, 2, 1, 1}};

static void ink_is_an_obstacle(void **state)
{
    (void)state;
    struct reader_obstacle *found;
    document_open();
    struct reader_remarks *remarks = remarks_open();
    ink_add(remarks, across, 3, "bridge");
    reader_remarks_close(remarks);
    for (int read = 0; read < 2; read++) { /* and as it was kept */
        remarks = remarks_open();
        assert_int_equal(obstacles_find(remarks, &found), 1);
        assert_ptr_equal(
            &document->blocks[found->block],
            reader_document_block(document, reader_remarks_get(remarks, 0)->begin));
        assert_int_equal(found->side, READER_AROUND_RIGHT);
        assert_true(fabs(found->width - 4.2) < 1e-3 && fabs(found->height - 2.2) < 1e-3);
        assert_true(fabs(found->x + 0.1) < 1e-3 && fabs(found->y + 0.1) < 1e-3);
        /* the first row has all of the line, those below its end alone */
        assert_true(found->rows[0].to_px - found->rows[0].from_px > 4);
        const struct page_row *last = &found->rows[found->rows_count - 1];
        assert_true(last->from_px > 3.8 && last->to_px < 4.21);
        free(found);
        reader_remarks_close(remarks);
    }
    remarks = remarks_open();
    assert_int_equal(reader_remarks_erase(remarks, 0, true), READER_OK);
    assert_int_equal(obstacles_find(remarks, &found), 0);
    free(found);
    assert_int_equal(reader_remarks_erase(remarks, 0, false), READER_OK);
    struct reader_arranged to = reader_remarks_arranged(remarks, 0);
    to.around = READER_AROUND_NOT;
    assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
    assert_int_equal(obstacles_find(remarks, &found), 0);
    free(found);
    reader_remarks_close(remarks);
    reader_document_destroy(document);
}

/* What lies between two strokes of a group is of its obstacle. */
static void groups_are_one(void **state)
{
    (void)state;
    struct reader_ink_point down[] = {{0, 0, 1, 0}, {0, 3, 1, 1}},
                            beside[] = {{6, 1, 1, 0}, {6, 2, 1, 1}};
    struct reader_obstacle *found;
    document_open();
    struct reader_remarks *remarks = remarks_open();
    ink_add(remarks, down, 2, "bridge");
    ink_add(remarks, beside, 2, "bridge");
    assert_int_equal(obstacles_find(remarks, &found), 2);
    free(found);
    struct reader_arranged to[2];
    for (int i = 0; i < 2; i++) {
        to[i] = reader_remarks_arranged(remarks, i);
        to[i].group = 0;
    }
    assert_int_equal(reader_remarks_arrange(remarks, to, 2), READER_OK);
    assert_int_equal(obstacles_find(remarks, &found), 1);
    const struct page_row *middle = &found->rows[found->rows_count / 2];
    assert_true(middle->to_px - middle->from_px > 6);
    assert_true(found->rows[0].to_px - found->rows[0].from_px < 0.3);
    free(found);
    reader_remarks_close(remarks);
    reader_document_destroy(document);
}

/* They stay ink, and no obstacles; and a hundred thousand points are looked at in a moment. */
static void large_ink_is_none(void **state)
{
    (void)state;
    enum { MANY = READER_INK_POINTS_MAX };
    struct reader_ink_point wide[] = {{0, 0, 1, 0}, {9e5f, 0, 1, 1}},
                            high[] = {{0, 0, 1, 0}, {0, 201, 1, 1}},
                            away[] = {{5e5f, 0, 1, 0}, {5e5f, 1, 1, 1}};
    struct reader_ink_point *many = malloc(MANY * sizeof *many);
    struct reader_obstacle *found;
    assert_non_null(many);
    for (int i = 0; i < MANY; i++)
        many[i] = (struct reader_ink_point){i % 2 ? 190 : 0, (float)(i * 7 % 190), 1, 0};
    document_open();
    struct reader_remarks *remarks = remarks_open();
    ink_add(remarks, wide, 2, "bridge");
    ink_add(remarks, high, 2, "bridge");
    ink_add(remarks, away, 2, "bridge");
    assert_int_equal(obstacles_find(remarks, &found), 0);
    free(found);
    const int scaled = ink_add(remarks, across, 3, "bridge");
    struct reader_arranged to = reader_remarks_arranged(remarks, scaled);
    to.scale_x = READER_SCALE_MOST;
    assert_int_equal(reader_remarks_arrange(remarks, &to, 1), READER_OK);
    assert_int_equal(obstacles_find(remarks, &found), 0);
    free(found);
    ink_add(remarks, many, MANY, "bridge");
    const clock_t before = clock();
    assert_int_equal(obstacles_find(remarks, &found), 1);
    const double seconds = (double)(clock() - before) / CLOCKS_PER_SEC;
    free(found);
    if (seconds > 5) /* a fraction of one here; sanitizers are slow */
        fail_msg("%g s for one stroke", seconds);
    reader_remarks_close(remarks);
    reader_document_destroy(document);
    free(many);
}

static void damaged_rows_are_refused(void **state)
{
    (void)state;
    static const char *const rows[] = {
        "UPDATE around SET side = 3", "UPDATE around SET side = -1",
        "UPDATE around SET side = 4294967297", "DROP TABLE around"};
    document_open();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        kept_begin(state);
        struct reader_remarks *remarks = remarks_open();
        ink_add(remarks, across, 3, "bridge");
        reader_remarks_close(remarks);
        kept_sql(rows[i]);
        assert_int_equal(reader_remarks_open(kept_path, &remarks), READER_FAILED);
        assert_non_null(strstr(reader_error(), kept_path));
    }
    reader_document_destroy(document);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(ink_is_an_obstacle, kept_begin),
        cmocka_unit_test_setup(groups_are_one, kept_begin),
        cmocka_unit_test_setup(large_ink_is_none, kept_begin),
        cmocka_unit_test_setup(damaged_rows_are_refused, kept_begin),
    };
    return kept_all(tests, sizeof tests / sizeof *tests);
}

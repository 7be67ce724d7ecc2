/* test_state_forged.c - forged states: HDF5 files with a correct header that refer to other
 * files, have types or filters that the program does not write, or hold values that no sheet
 * can have. All are refused with a message. (security.md 8, 9, 10) */
#include "state_sample.h"

#include "../display/scratch.h"

#include <event/event.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>
#include <hdf5.h>

static char path[512], secret[512];

/* Writes a good state; it is saved once and then copied. */
static void good_save(bool brush)
{
    static struct {
        uint8_t *bytes;
        size_t count;
    } saved[2];
    if (saved[brush].bytes) {
        sample_file_write(path, saved[brush].bytes, saved[brush].count);
        return;
    }
    struct paper_sheet *sheet = sample_sheet(9);
    sample_paint(sheet, 2);
    if (brush) {
        struct paper_brush hairy = paper_brush_default();
        hairy.bristles = 5;
        sample_check(paper_sheet_brush(sheet, &hairy));
        sample_check(paper_sheet_dip(
            sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.5}}));
    }
    sample_check(paper_state_save(path, &(struct paper_state_sheet){1, sheet}, 1));
    paper_sheet_destroy(sheet);
    assert_int_equal(sample_load_all(path), PAPER_OK);
    saved[brush].bytes = sample_file_read(path, &saved[brush].count);
}

static void header_agree(void)
{
    size_t count;
    uint8_t *bytes = sample_file_read(path, &count);
    sample_header_mend(bytes, count);
    sample_file_write(path, bytes, count);
    free(bytes);
}

/* Changes a good state, and makes its header agree. */
static void forge(void (*change)(hid_t file))
{
    good_save(false);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(file >= 0);
    change(file);
    assert_true(H5Fclose(file) >= 0);
    header_agree();
}

static void refused(const char *says)
{
    enum paper_status status = sample_load_all(path);
    if (status != PAPER_BAD_FILE || !strstr(paper_error(), says) ||
        !strstr(paper_error(), path) || strchr(paper_error(), '\n'))
        fail_msg("status %d, it said: %s", (int)status, paper_error());
}

/* ---- data that is elsewhere ---- */

enum { PLANE_ROWS = SAMPLE_HEIGHT, PLANE_COLUMNS = SAMPLE_WIDTH };

/* Replaces a plane by another dataset. */
static void plane_make(hid_t file, hid_t type, hid_t how, const hsize_t size[2])
{
    hid_t space = H5Screate_simple(2, size, NULL);
    assert_true(H5Ldelete(file, "sheet-1/planes/height", H5P_DEFAULT) >= 0);
    hid_t set =
        H5Dcreate2(file, "sheet-1/planes/height", type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    assert_true(set >= 0);
    H5Dclose(set);
    H5Sclose(space);
}

static const hsize_t plane_size[2] = {PLANE_ROWS, PLANE_COLUMNS};

static void external_storage(hid_t file)
{
    hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(how, secret, 0, 4 * PLANE_ROWS * PLANE_COLUMNS);
    plane_make(file, H5T_IEEE_F32LE, how, plane_size);
    H5Pclose(how);
}

static void external_run(hid_t file)
{
    hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    hsize_t size = 64;
    hid_t space = H5Screate_simple(1, &size, NULL);
    H5Pset_external(how, secret, 0, 64);
    H5Ldelete(file, "sheet-1/run", H5P_DEFAULT);
    hid_t set =
        H5Dcreate2(file, "sheet-1/run", H5T_STD_U8LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
    assert_true(set >= 0);
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(how);
}

static void virtual_storage(hid_t file)
{
    hid_t how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(2, plane_size, NULL);
    assert_true(H5Pset_virtual(how, space, secret, "sheet-1/planes/height", space) >= 0);
    plane_make(file, H5T_IEEE_F32LE, how, plane_size);
    H5Sclose(space);
    H5Pclose(how);
}

static void soft_link(hid_t file)
{
    assert_true(H5Lmove(file, "sheet-1/planes/height", file, "sheet-1/planes/elsewhere",
                        H5P_DEFAULT, H5P_DEFAULT) >= 0);
    assert_true(H5Lcreate_soft("/sheet-1/planes/elsewhere", file, "sheet-1/planes/height",
                               H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void external_link(hid_t file)
{
    H5Ldelete(file, "sheet-1/planes/height", H5P_DEFAULT);
    assert_true(H5Lcreate_external(secret, "/sheet-1/planes/height", file,
                                   "sheet-1/planes/height", H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void external_group(hid_t file)
{
    H5Ldelete(file, "sheet-1", H5P_DEFAULT);
    assert_true(
        H5Lcreate_external(secret, "/sheet-1", file, "sheet-1", H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void second_name(hid_t file)
{
    H5Ldelete(file, "sheet-1/planes/height", H5P_DEFAULT);
    assert_true(H5Lcreate_hard(file, "sheet-1/planes/capacity", file, "sheet-1/planes/height",
                               H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void states_reach_for_no_other_file(void **state)
{
    (void)state;
    static const struct {
        void (*change)(hid_t file);
        const char *says;
    } rows[] = {
        {external_storage, "kept in another file"},
        {external_run, "kept in another file"},
        {virtual_storage, "gathered from elsewhere"},
        {soft_link, "leads elsewhere"},
        {external_link, "leads elsewhere"},
        {external_group, "leads elsewhere"},
        {second_name, "several names"},
    };
    /* the other file is a good state: files are refused because they refer to it, whatever it
     * holds */
    snprintf(path, sizeof path, "%s", scratch_path("secret.h5"));
    snprintf(secret, sizeof secret, "%s", path);
    good_save(false);
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        forge(rows[i].change);
        refused(rows[i].says);
    }
}

/* Opening a FIFO would block for ever, both as another file and as the state itself. */
static void pipes_hold_nobody(void **state)
{
    (void)state;
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    snprintf(secret, sizeof secret, "%s", scratch_path("pipe"));
    assert_int_equal(mkfifo(secret, 0600), 0);
    alarm(20); /* ends the test */
    forge(external_storage);
    refused("kept in another file");
    struct paper_state *none;
    assert_int_equal(paper_state_open(secret, &none), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "no regular file"));
    alarm(0);
    unlink(secret);
}

/* ---- filters, types, layouts ---- */

static hid_t chunked(void)
{
    hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 2, plane_size);
    return how;
}

#define FILTER(name, set)                                                                      \
    static void name(hid_t file)                                                               \
    {                                                                                          \
        hid_t how = chunked();                                                                 \
        assert_true((set) >= 0);                                                               \
        plane_make(file, H5T_IEEE_F32LE, how, plane_size);                                     \
        H5Pclose(how);                                                                         \
    }
FILTER(filter_fletcher, H5Pset_fletcher32(how))
FILTER(filter_scale, H5Pset_scaleoffset(how, H5Z_SO_FLOAT_DSCALE, 3))
FILTER(filter_bits, H5Pset_nbit(how))
FILTER(filter_foreign, H5Pset_filter(how, 32000, H5Z_FLAG_OPTIONAL, 0, NULL))
FILTER(filter_many,
       H5Pset_deflate(how, 1) >= 0 && H5Pset_shuffle(how) >= 0 && H5Pset_deflate(how, 9) >= 0
           ? 0
           : -1)

static void typed(hid_t file, hid_t type)
{
    hid_t how = chunked();
    plane_make(file, type, how, plane_size);
    H5Pclose(how);
}

static void type_double(hid_t file)
{
    typed(file, H5T_IEEE_F64LE);
}

static void type_big(hid_t file)
{
    typed(file, H5T_IEEE_F32BE);
}

static void type_whole(hid_t file) /* where floats are */
{
    typed(file, H5T_STD_U32LE);
}

static void type_reference(hid_t file)
{
    typed(file, H5T_STD_REF_OBJ);
}

static void type_region(hid_t file)
{
    typed(file, H5T_STD_REF_DSETREG);
}

static void type_string(hid_t file)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    typed(file, type);
    H5Tclose(type);
}

static void type_compound(hid_t file)
{
    hid_t type = H5Tcreate(H5T_COMPOUND, 4);
    H5Tinsert(type, "x", 0, H5T_IEEE_F32LE);
    typed(file, type);
    H5Tclose(type);
}

static void type_varying(hid_t file)
{
    hid_t type = H5Tvlen_create(H5T_IEEE_F32LE);
    typed(file, type);
    H5Tclose(type);
}

static void type_named(hid_t file)
{
    hid_t type = H5Tcopy(H5T_IEEE_F32LE);
    assert_true(H5Tcommit_anon(file, type, H5P_DEFAULT, H5P_DEFAULT) >= 0);
    typed(file, type);
    H5Tclose(type);
}

static void layout_compact(hid_t file)
{
    hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_layout(how, H5D_COMPACT);
    plane_make(file, H5T_IEEE_F32LE, how, plane_size);
    H5Pclose(how);
}

static void layout_whole(hid_t file)
{
    plane_make(file, H5T_IEEE_F32LE, H5P_DEFAULT, plane_size);
}

static void size_huge(hid_t file)
{
    hid_t how = chunked();
    plane_make(file, H5T_IEEE_F32LE, how, (const hsize_t[]){1ull << 40, 1ull << 20});
    H5Pclose(how);
}

static void size_other(hid_t file)
{
    hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 2, (const hsize_t[]){4, 4});
    plane_make(file, H5T_IEEE_F32LE, how, (const hsize_t[]){PLANE_ROWS, PLANE_COLUMNS - 1});
    H5Pclose(how);
}

/* A dataset of gigabytes whose data are not in the file: HDF5 would fill it with zeros. */
static void run_absent(hid_t file)
{
    hsize_t size = 1u << 31;
    hid_t space = H5Screate_simple(1, &size, NULL);
    H5Ldelete(file, "sheet-1/run", H5P_DEFAULT);
    hid_t set = H5Dcreate2(file, "sheet-1/run", H5T_STD_U8LE, space, H5P_DEFAULT, H5P_DEFAULT,
                           H5P_DEFAULT);
    H5Dclose(set);
    H5Sclose(space);
}

static void plane_more(hid_t file)
{
    assert_true(H5Ocopy(file, "sheet-1/planes/height", file, "sheet-1/planes/depth",
                        H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void sheet_more(hid_t file)
{
    H5Gclose(H5Gcreate2(file, "sheet-2", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

static void group_as_plane(hid_t file)
{
    H5Ldelete(file, "sheet-1/planes/height", H5P_DEFAULT);
    H5Gclose(H5Gcreate2(file, "sheet-1/planes/height", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

static void circle(hid_t file)
{
    H5Ldelete(file, "sheet-1/planes", H5P_DEFAULT);
    assert_true(
        H5Lcreate_hard(file, "sheet-1", file, "sheet-1/planes", H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void note_reference(hid_t file)
{
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t note = H5Acreate_by_name(file, "sheet-1/planes/height", "to", H5T_STD_REF_OBJ, space,
                                   H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    hobj_ref_t to;
    assert_true(H5Rcreate(&to, file, "sheet-1", H5R_OBJECT, -1) >= 0);
    assert_true(H5Awrite(note, H5T_STD_REF_OBJ, &to) >= 0);
    H5Aclose(note);
    H5Sclose(space);
}

static void only_what_we_write_is_read(void **state)
{
    (void)state;
    static const struct {
        void (*change)(hid_t file);
        const char *says;
    } rows[] = {
        {filter_fletcher, "filter"},
        {filter_scale, "filter"},
        {filter_bits, "filter"},
        {filter_foreign, "filter"},
        {filter_many, "filter"},
        {type_double, "type"},
        {type_big, "type"},
        {type_whole, "type"},
        {type_reference, "type"},
        {type_region, "type"},
        {type_string, "type"},
        {type_compound, "type"},
        {type_varying, "type"},
        {type_named, "type"},
        {layout_compact, "laid out"},
        {layout_whole, "laid out"},
        {size_huge, "size"},
        {size_other, "size"},
        {run_absent, "its run is not in it"},
        {plane_more, "plane"},
        {sheet_more, "header does not tell"},
        {group_as_plane, "of another kind"},
        {circle, "several names"},
        {note_reference, "notes"},
    };
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        forge(rows[i].change);
        refused(rows[i].says);
    }
}

/* ---- memory ---- */

static void readers_take_what_they_may(void **state)
{
    (void)state;
    struct paper_state *saved;
    struct paper_sheet_config config;
    struct paper_sheet *sheet;
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    good_save(false);
    sample_check(paper_state_open(path, &saved));
    paper_state_limit(saved, 100);
    assert_int_equal(paper_state_describe(saved, 0, &config), PAPER_NO_MEMORY);
    assert_int_equal(paper_state_load(saved, 0, false, 0, &sheet), PAPER_NO_MEMORY);
    assert_non_null(strstr(paper_error(), path));
    paper_state_limit(saved, 1e6);
    sample_check(paper_state_load(saved, 0, false, 0, &sheet));
    paper_sheet_destroy(sheet);
    paper_state_close(saved);
}

/* ---- numbers that cannot be ---- */

static void data_change(const char *name, hid_t type, size_t at, size_t size, const void *with)
{
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT),
          set = H5Dopen2(file, name, H5P_DEFAULT);
    static uint8_t bytes[1 << 20];
    assert_true(set >= 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes) >= 0);
    memcpy(bytes + at, with, size);
    assert_true(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes) >= 0);
    H5Dclose(set);
    H5Fclose(file);
    header_agree();
}

static size_t run_find(const void *what, size_t size)
{
    size_t count;
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT),
          set = H5Dopen2(file, "sheet-1/run", H5P_DEFAULT);
    static uint8_t bytes[1 << 20];
    H5Dread(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes);
    count = (size_t)H5Dget_storage_size(set);
    H5Dclose(set);
    H5Fclose(file);
    const uint8_t *found = memmem(bytes, count, what, size);
    assert_non_null(found);
    return (size_t)(found - bytes);
}

/* Refused with and without `follow`, which reads the brushes much later. */
static void refused_both_ways(const char *says)
{
    struct paper_state *saved;
    struct paper_sheet *sheet;
    sample_check(paper_state_open(path, &saved));
    for (int follow = 0; follow < 2; follow++) {
        enum paper_status status = paper_state_load(saved, 0, follow, 1e6, &sheet);
        assert_null(sheet);
        if (status != PAPER_BAD_FILE || !strstr(paper_error(), says))
            fail_msg("follow %d: status %d, it said: %s", follow, (int)status, paper_error());
    }
    paper_state_close(saved);
}

static void planes_hold_what_sheets_can(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double value;
    } rows[] = {
        {"height", 1.5},
        {"height", -0.25},
        {"height", (double)NAN},
        {"absorbency", 0.5},
        {"capacity", 0},
        {"capacity", 2},
        {"resist", 7},
        {"resist", -1},
        {"varnish", 1.5},
        {"salt", 5},
        {"brine", -1e-3},
        {"wet around", 2},
        {"infused water", 0.5},
        {"surface water", -1},
        {"infused pigment 1", 1e9},
        {"infused pigment 2", 3.25},
        {"red", -1},
    };
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char name[80];
        float value = (float)rows[i].value;
        good_save(false);
        snprintf(name, sizeof name, "sheet-1/planes/%s", rows[i].name);
        data_change(name, H5T_NATIVE_FLOAT, 40, sizeof value, &value);
        snprintf(name, sizeof name, "'%s' holds what no sheet can", rows[i].name);
        refused_both_ways(name);
    }
}

/* In the run, the grains of a brush's bristles follow its description; here one is wrong. */
static void brushes_hold_what_brushes_can(void **state)
{
    (void)state;
    static const double wrong[] = {-1, 0.5, 0x1p46, (double)NAN, (double)INFINITY};
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct paper_brush hairy = paper_brush_default();
        struct event_bytes b = {0};
        hairy.bristles = 5;
        good_save(true);
        event_encode(&b, sheet_event_kind(SHEET_EVENT_BRUSH), &hairy, NULL);
        size_t at = run_find(b.at, b.count);
        data_change("sheet-1/run", H5T_NATIVE_UINT8, at + b.count + 8 * (i % 5), sizeof *wrong,
                    &wrong[i]);
        free(b.at);
        refused_both_ways("brushes are damaged");
    }
}

/* A dip of amount -1, and dips of brushes that do not exist: each is refused before it is
 * carried out. */
static void operations_are_ones_that_can_be(void **state)
{
    (void)state;
    struct paper_dip dip = {.part = 1, .side = {-1, 1}, .amount = {1, 0.5}};
    struct event_bytes b = {0}, forged[3] = {{0}};
    struct paper_sheet *sheet = sample_sheet(9);
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    event_encode(&b, sheet_event_kind(SHEET_EVENT_DIP), &dip, config);
    dip.amount[0] = -1;
    event_encode(&forged[0], sheet_event_kind(SHEET_EVENT_DIP), &dip, config);
    dip.amount[0] = 1;
    dip.number = 3;
    event_encode(&forged[1], sheet_event_kind(SHEET_EVENT_DIP), &dip, config);
    dip.number = -7;
    event_encode(&forged[2], sheet_event_kind(SHEET_EVENT_DIP), &dip, config);
    snprintf(path, sizeof path, "%s", scratch_path("forged.h5"));
    for (int i = 0; i < 3; i++) {
        good_save(true);
        size_t at = run_find(b.at, b.count);
        data_change("sheet-1/run", H5T_NATIVE_UINT8, at, forged[i].count, forged[i].at);
        refused_both_ways("an operation of the run is damaged");
        free(forged[i].at);
    }
    free(b.at);
    paper_sheet_destroy(sheet);
}

/* ---- older versions ---- */

static void stained_forget(hid_t file)
{
    assert_true(H5Ldelete(file, "sheet-1/planes/stained part", H5P_DEFAULT) >= 0);
}

/* A state of version 1 has no stained parts: they are read as 0, and steps go on. One that has
 * some is none of version 1. */
static void states_of_version_1_are_read(void **state)
{
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        if (turn == 0)
            forge(stained_forget);
        else
            good_save(false);
        size_t count;
        uint8_t *bytes = sample_file_read(path, &count);
        sample_header_mend_of(bytes, count, 1);
        sample_file_write(path, bytes, count);
        free(bytes);
        if (turn == 0)
            assert_int_equal(sample_load_all(path), PAPER_OK);
        else
            refused("a plane is missing in it");
    }
    forge(stained_forget);
    refused("a plane is missing in it");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_reach_for_no_other_file),
        cmocka_unit_test(pipes_hold_nobody),
        cmocka_unit_test(only_what_we_write_is_read),
        cmocka_unit_test(readers_take_what_they_may),
        cmocka_unit_test(planes_hold_what_sheets_can),
        cmocka_unit_test(brushes_hold_what_brushes_can),
        cmocka_unit_test(operations_are_ones_that_can_be),
        cmocka_unit_test(states_of_version_1_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

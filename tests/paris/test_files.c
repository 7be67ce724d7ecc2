/* Fields to files and back: <cm/cmfs.h> and <lutetia/fields.h>, beside bytes that the test
 * makes itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "device.h"
#include "test_files.h"
#include <cm/cmfs.h>

size_t file_read(const char *path, uint8_t *bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(bytes, 1, BYTES_MOST, file);
    fclose(file);
    return count;
}

void file_write(const char *path, const void *bytes, size_t count)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

/* Writes `len` random bits to each processor, bit by bit; values[i] holds those of processor i,
 * 32 bytes each. */
CM_field_id_t field_make(unsigned int len, uint8_t (*values)[32])
{
    CM_field_id_t field = CM_allocate_heap_field(len);
    memset(values, 0, COUNT * sizeof *values);
    for (unsigned int bit = 0; bit < len; bit++) {
        uint8_t bits[COUNT];
        for (int i = 0; i < COUNT; i++) {
            bits[i] = device_random() & 1;
            values[i][bit / 8] |= (uint8_t)(bits[i] << bit % 8);
        }
        assert_int_equal(machine_field_upload(paris_machine(), field + bit, MACHINE_BIT, bits),
                         MACHINE_OK);
    }
    return field;
}

void field_is(CM_field_id_t field, unsigned int len, uint8_t (*values)[32])
{
    for (unsigned int bit = 0; bit < len; bit++) {
        uint8_t bits[COUNT];
        assert_int_equal(
            machine_field_download(paris_machine(), field + bit, MACHINE_BIT, bits),
            MACHINE_OK);
        for (int i = 0; i < COUNT; i++)
            if (bits[i] != (values[i][bit / 8] >> bit % 8 & 1))
                fail_msg("%u bits: bit %u of processor %d is %d", len, bit, i, bits[i]);
    }
}

static const unsigned int lengths[] = {1, 5, 8, 12, 16, 24, 32, 33, 64, 65, 100, 128, 200};

static void fields_go_through_files_of_the_machine(void **unused)
{
    (void)unused;
    static uint8_t values[2][COUNT][32], bytes[BYTES_MOST];
    for (size_t c = 0; c < sizeof lengths / sizeof *lengths; c++) {
        const unsigned int len = lengths[c], each = (len + 7) / 8;
        const char *path = scratch_path("fields");
        CM_field_id_t a = field_make(len, values[0]), b = field_make(len, values[1]);
        CM_field_id_t to = CM_allocate_heap_field(len);
        int file = CMFS_open(path, CMFS_O_RDWR | CMFS_O_CREAT | CMFS_O_TRUNC, 0644);
        assert_true(file >= 0);
        CM_clear_context(); /* does not matter */
        assert_int_equal(CMFS_write_file_always(file, a, len), len);
        assert_int_equal(CMFS_write_file_always(file, b, len), len);
        assert_int_equal(CMFS_serial_write_file(file, "end", 3), 3);
        assert_int_equal(file_read(path, bytes), 2 * COUNT * each + 3);
        for (int n = 0; n < 2; n++)
            for (int i = 0; i < COUNT; i++)
                assert_memory_equal(bytes + (n * COUNT + i) * (int)each, values[n][i], each);
        assert_int_equal(CMFS_lseek(file, 1, len, CMFS_L_SET), COUNT * each);
        assert_int_equal(CMFS_read_file_always(file, to, len), len);
        field_is(to, len, values[1]);
        assert_int_equal(CMFS_read_file_always(file, to, len), -1); /* three bytes are left */
        field_is(to, len, values[1]);
        assert_int_equal(CMFS_serial_lseek(file, 0, CMFS_L_SET), 0);
        assert_int_equal(CMFS_read_file(file, to, len), len); /* nobody is active */
        field_is(to, len, values[1]);
        CM_set_context();
        assert_int_equal(CMFS_serial_lseek(file, -3, CMFS_L_XTND), 2 * COUNT * each);
        assert_int_equal(CMFS_serial_read_file(file, bytes, 9), 3);
        assert_memory_equal(bytes, "end", 3);
        assert_int_equal(CMFS_read_file(file, to, len), 0); /* the end */
        assert_int_equal(CMFS_lseek(file, 0, len, CMFS_L_SET), 0);
        assert_int_equal(CMFS_read_file(file, to, len), len);
        field_is(to, len, values[0]);
        assert_int_equal(CMFS_close(file), 0);
        CM_deallocate_heap_field(a);
        CM_deallocate_heap_field(b);
        CM_deallocate_heap_field(to);
    }
}

static void active_processors_alone_take_what_is_read(void **unused)
{
    (void)unused;
    static uint8_t values[2][COUNT][32], mask[COUNT][32];
    const char *path = scratch_path("some");
    CM_field_id_t a = field_make(70, values[0]), b = field_make(70, values[1]);
    CM_field_id_t where = field_make(1, mask);
    int file = CMFS_open(path, CMFS_O_RDWR | CMFS_O_CREAT, 0600);
    assert_int_equal(CMFS_write_file_always(file, a, 70), 70);
    CMFS_serial_lseek(file, 0, CMFS_L_SET);
    CM_load_context(where);
    assert_int_equal(CMFS_read_file(file, b, 70), 70);
    CM_set_context();
    for (int i = 0; i < COUNT; i++)
        if (mask[i][0])
            memcpy(values[1][i], values[0][i], 32);
    field_is(b, 70, values[1]);
    CMFS_close(file);
}

static void wrong_files_are_said(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32];
    const char *folder = scratch_path("folder"), *fifo = scratch_path("fifo");
    CM_field_id_t field = field_make(8, values);
    assert_int_equal(CMFS_open(scratch_path("none"), CMFS_O_RDWR), -1);
    assert_true(CMFS_errno != 0);
    assert_int_equal(mkdir(folder, 0700), 0);
    assert_int_equal(CMFS_open(folder, CMFS_O_RDONLY), -1);
    assert_int_equal(mkfifo(fifo, 0600), 0);
    assert_int_equal(CMFS_open(fifo, CMFS_O_RDONLY), -1);
    assert_int_equal(CMFS_open("/dev/null", CMFS_O_RDWR), -1);
    assert_int_equal(CMFS_open("x", 4), -1);
    device_said("CMFS_open", "flags");
    assert_int_equal(CMFS_open(NULL, 0), -1);
    device_said("CMFS_open", "path");
    assert_int_equal(CMFS_write_file_always(-1, field, 8), -1);
    int file = CMFS_open(scratch_path("file"), CMFS_O_WRONLY | CMFS_O_CREAT, 0600);
    assert_int_equal(CMFS_write_file_always(file, field, 9), -1);
    device_said("CMFS_write_file_always", "source");
    assert_int_equal(CMFS_write_file_always(file, field, 0), -1);
    device_said("CMFS_write_file_always", "len");
    assert_int_equal(CMFS_serial_lseek(file, 0, 7), -1);
    device_said("CMFS_serial_lseek", "whence");
    assert_int_equal(CMFS_serial_lseek(file, 0, CMFS_L_INCR), 0);
    CMFS_close(file);
    assert_int_equal(CMFS_unlink(scratch_path("file")), 0);
    assert_int_equal(CMFS_unlink(scratch_path("file")), -1);
}

/* ---- files of today ---- */

static const struct {
    const char *type;
    unsigned int len, bits;
    const char *descr;
} types[] = {{"b1", 0, 1, "|b1"},   {"u1", 0, 8, "|u1"},    {"u1", 3, 3, "|u1"},
             {"u2", 0, 16, "<u2"},  {"u4", 24, 24, "<u4"},  {"u8", 0, 64, "<u8"},
             {"i1", 0, 8, "|i1"},   {"i2", 12, 12, "<i2"},  {"i4", 0, 32, "<i4"},
             {"i8", 33, 33, "<i8"}, {"f4", 0, 32, "<f4"},   {"f8", 0, 64, "<f8"},
             {"c8", 0, 64, "<c8"},  {"c16", 0, 128, "<c16"}};

/* A value as the file has it: signed ones are as long as the type. */
static void value_widen(uint8_t *value, unsigned int bits, unsigned int bytes, bool is_signed)
{
    if (!is_signed || !(value[(bits - 1) / 8] >> (bits - 1) % 8 & 1))
        return;
    for (unsigned int bit = bits; bit < 8 * bytes; bit++)
        value[bit / 8] |= (uint8_t)(1 << bit % 8);
}

static void fields_go_through_npy_and_raw(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32], wide[COUNT][32], bytes[BYTES_MOST], turned[BYTES_MOST];
    for (size_t c = 0; c < sizeof types / sizeof *types; c++)
        for (int raw = 0; raw < 2; raw++) {
            const char *path = scratch_path(raw ? "field.raw" : "field.npy");
            const unsigned int each = (unsigned int)atoi(types[c].type + 1);
            CM_field_id_t field = field_make(types[c].bits, values);
            CM_field_id_t to = CM_allocate_heap_field(types[c].bits);
            assert_int_equal(lutetia_field_write(path, field, types[c].type, types[c].len), 1);
            const size_t all = file_read(path, bytes), head = raw ? 0 : 128;
            assert_int_equal(all, head + COUNT * each);
            if (!raw) {
                char text[80];
                snprintf(text, sizeof text,
                         "{'descr': '%s', 'fortran_order': False, 'shape': (5, 13), }",
                         types[c].descr);
                assert_memory_equal(bytes, "\x93NUMPY\x01\x00\x76\x00", 10);
                assert_memory_equal(bytes + 10, text, strlen(text));
                assert_int_equal(bytes[127], '\n');
            }
            memcpy(wide, values, sizeof wide);
            for (int i = 0; i < COUNT; i++) {
                value_widen(wide[i], types[c].bits, each, types[c].type[0] == 'i');
                assert_memory_equal(bytes + head + (size_t)i * each, wide[i], each);
            }
            assert_int_equal(lutetia_field_read(path, to, types[c].type, types[c].len), 1);
            field_is(to, types[c].bits, values);
            /* The same with the bytes of each number turned round. */
            const size_t part = types[c].type[0] == 'c' ? each / 2 : each;
            char *descr = memchr(bytes, '<', all);
            if (raw || each == 1)
                continue;
            *descr = '>';
            memcpy(turned, bytes, head);
            for (size_t i = head; i < all; i++)
                turned[i] =
                    bytes[head + (i - head) / part * part + part - 1 - (i - head) % part];
            file_write(path, turned, all);
            CM_u_move_zero_1L(to, types[c].bits);
            assert_int_equal(lutetia_field_read(path, to, types[c].type, types[c].len), 1);
            field_is(to, types[c].bits, values);
        }
}

static void npy_write(const char *path, const char *dictionary, size_t values)
{
    uint8_t bytes[4096] = "\x93NUMPY\x01";
    const size_t length = strlen(dictionary);
    bytes[8] = (uint8_t)length;
    bytes[9] = (uint8_t)(length >> 8);
    memcpy(bytes + 10, dictionary, length);
    file_write(path, bytes, 10 + length + values);
}

#define NPY(type, order, shape)                                                                \
    "{'descr': '" type "', 'fortran_order': " order ", 'shape': " shape "}"

static void other_files_are_refused(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32];
    static const struct {
        const char *dictionary;
        size_t values;
        const char *says;
    } wrongs[] = {{NPY("<f4", "False", "(5, 13)"), 260, "are f4, not u1"},
                  {NPY("|u1", "True", "(5, 13)"), 65, "Fortran"},
                  {NPY("|u1", "False", "(13, 5)"), 65, "shape is 13x5, the VP set's is 5x13"},
                  {NPY("|u1", "False", "(65,)"), 65, "shape is 65"},
                  {NPY("|u1", "False", "()"), 65, "shape is "},
                  {NPY("|u1", "False", "(5, 13)"), 64, "bytes, and the VP set's values take"},
                  {NPY("|u1", "False", "(5, 13)"), 66, "bytes, and the VP set's values take"},
                  {NPY("|O", "False", "(5, 13)"), 65, "no plain numbers"},
                  {NPY("|u1", "False", "(5, 13"), 65, "shape has"},
                  {NPY("|u1", "False", "5"), 65, "no tuple"},
                  {NPY("|u1", "Maybe", "(5, 13)"), 65, "order is unknown"},
                  {NPY("|u1", "False", "(99999999999999999999, 13)"), 65, "too large"},
                  {"{'descr': '|u1', 'shape': (5, 13)}", 65, "lacks"},
                  {"{'descr': '|u1', 'more': 1}", 65, "unknown key"},
                  {"[]", 65, "no dictionary"}};
    CM_field_id_t field = field_make(8, values);
    const char *path = scratch_path("wrong.npy");
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        npy_write(path, wrongs[i].dictionary, wrongs[i].values);
        assert_int_equal(lutetia_field_read(path, field, "u1", 0), 0);
        device_said("lutetia_field_read", wrongs[i].says);
        field_is(field, 8, values);
    }
    npy_write(path, NPY("|u1", "False", "( 5,13 , )") "   \n", 65);
    assert_int_equal(lutetia_field_read(path, field, "u1", 0), 1);
    unsigned int shape[3] = {0, 0, 7};
    assert_int_equal(lutetia_file_shape(path, shape, 3), 2);
    assert_int_equal(shape[0] * 100 + shape[1], 513);
    assert_int_equal(shape[2], 7);
    assert_int_equal(lutetia_file_shape(path, shape, 0), 2);
    file_write(path, "\x93NUMPX", 6);
    assert_int_equal(lutetia_file_shape(path, shape, 3), -1);
    device_said("lutetia_file_shape", "no .npy file");

    uint8_t large[COUNT] = {[40] = 8};
    field = field_make(3, values);
    file_write(scratch_path("large.raw"), large, COUNT);
    assert_int_equal(lutetia_field_read(scratch_path("large.raw"), field, "u1", 3), 0);
    device_said("lutetia_field_read", "does not fit into the field's 3 bits");
    large[40] = 0xfb; /* -5 */
    file_write(scratch_path("large.raw"), large, COUNT);
    assert_int_equal(lutetia_field_read(scratch_path("large.raw"), field, "i1", 3), 0);
    device_said("lutetia_field_read", "does not fit");
    field_is(field, 3, values);
    large[40] = 0xfc; /* -4 */
    file_write(scratch_path("large.raw"), large, COUNT);
    assert_int_equal(lutetia_field_read(scratch_path("large.raw"), field, "i1", 3), 1);

    assert_int_equal(lutetia_field_write("field.txt", field, "u1", 3), 0);
    device_said("lutetia_field_write", "must end in");
    assert_int_equal(lutetia_field_write("x.npy", field, "u3", 3), 0);
    device_said("lutetia_field_write", "type");
    assert_int_equal(lutetia_field_write("x.npy", field, "f4", 3), 0);
    device_said("lutetia_field_write", "len");
    assert_int_equal(lutetia_field_write("x.npy", field, "u1", 0), 0);
    device_said("lutetia_field_write", "field");
    assert_int_equal(lutetia_field_write("/proc/x.npy", field, "u1", 3), 0);
    device_said("lutetia_field_write", "/proc/x.npy: cannot write");
    assert_int_equal(lutetia_field_read(scratch_path("none.npy"), field, "u1", 3), 0);
    device_said("lutetia_field_read", "none.npy");
}

/* Damaged heads are read or refused; what is read has the set's shape, so the field is
 * right. */
static void damaged_npy_files_are_refused_or_read(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32], bytes[BYTES_MOST];
    const char *path = scratch_path("damaged.npy");
    CM_field_id_t field = field_make(16, values), to = CM_allocate_heap_field(16);
    unsigned int shape[4];
    int read = 0;
    assert_int_equal(lutetia_field_write(path, field, "u2", 0), 1);
    const size_t all = file_read(path, bytes);
    for (int n = 0; n < 1500; n++) {
        uint8_t damaged[BYTES_MOST];
        size_t count = all;
        memcpy(damaged, bytes, all);
        for (uint64_t k = 1 + device_random() % 3; k > 0; k--) {
            const uint64_t die = device_random() % 10, at = device_random() % 80;
            if (die == 0)
                count = device_random() % all;
            else if (die < 6)
                damaged[at] = (uint8_t)device_random();
            else
                damaged[at] = (uint8_t) "0123456789,:'{}()<>| "[device_random() % 21];
        }
        file_write(path, damaged, count);
        device_message[0] = '\0';
        const int good = lutetia_field_read(path, to, "u2", 0);
        assert_int_equal(good, !device_message[0]);
        read += good;
        device_message[0] = '\0';
        (void)lutetia_file_shape(path, shape, 4);
    }
    device_message[0] = '\0';
    assert_in_range(read, 30, 1200);
}

static int start(void **unused)
{
    (void)unused;
    device_start(-1);
    CM_set_error_handler(device_error_catch);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_go_through_files_of_the_machine),
        cmocka_unit_test(active_processors_alone_take_what_is_read),
        cmocka_unit_test(wrong_files_are_said),
        cmocka_unit_test(fields_go_through_npy_and_raw),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(damaged_npy_files_are_refused_or_read),
        cmocka_unit_test(fields_go_to_hdf5),
        cmocka_unit_test(fields_come_from_hdf5),
        cmocka_unit_test(groups_of_all_ages_have_their_names),
        cmocka_unit_test(damaged_hdf5_files_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}

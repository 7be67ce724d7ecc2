/* fuzz_png.c - reads damaged PNGs. Each is read, or refused with a reason.
 *
 * The damage to a valid file: bytes are changed, runs are removed or doubled, or the end is cut
 * off. Half of the files then get correct checksums in their chunks, so that the reader does
 * not refuse them at once. (security.md 7) */
#include <display.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sample.h"
#include "scratch.h"

enum { MUTATIONS = 600, BYTES_MAX = 1 << 16 };

static uint64_t random_state = 20;

static size_t file_read(const char *path, uint8_t *bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t count = fread(bytes, 1, BYTES_MAX, file);
    fclose(file);
    return count;
}

static void file_write(const char *path, const uint8_t *bytes, size_t count)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

static uint32_t big_endian(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static uint32_t crc32_of(const uint8_t *bytes, size_t count)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

static void checksums_mend(uint8_t *bytes, size_t count)
{
    for (size_t at = 8; at + 12 <= count;) {
        size_t length = big_endian(bytes + at);
        if (length > count - at - 12)
            return;
        uint32_t crc = crc32_of(bytes + at + 4, length + 4);
        for (int i = 0; i < 4; i++)
            bytes[at + 8 + length + (size_t)i] = (uint8_t)(crc >> (24 - 8 * i));
        at += length + 12;
    }
}

/* Whether the header's size is huge. The reader refuses it by its size; skipping it keeps the
 * fuzzing quick. */
static bool header_is_huge(const uint8_t *bytes, size_t count)
{
    return count >= 24 && (double)big_endian(bytes + 16) * big_endian(bytes + 20) > 1e8;
}

static size_t mutate(uint8_t *bytes, size_t count)
{
    uint32_t changes = 1 + sample_below(&random_state, 6);
    for (uint32_t i = 0; i < changes && count > 8; i++) {
        uint32_t at = sample_below(&random_state, (uint32_t)count),
                 run = 1 + sample_below(&random_state, 24);
        switch (sample_below(&random_state, 5)) {
        case 0:
            bytes[at] = (uint8_t)sample_below(&random_state, 256);
            break;
        case 1:
            bytes[at] ^= (uint8_t)(1u << sample_below(&random_state, 8));
            break;
        case 2: /* changes the header, which is short, often */
            bytes[16 + sample_below(&random_state, 13) % (count > 29 ? 13 : 1)] =
                (uint8_t)sample_below(&random_state, 20);
            break;
        case 3:
            run = run < count - at ? run : (uint32_t)count - at;
            memmove(bytes + at, bytes + at + run, count - at - run);
            count -= run;
            break;
        default:
            count = at;
            break;
        }
    }
    return count;
}

static void damaged_files_are_read_or_refused(void **state)
{
    (void)state;
    static uint8_t whole[2][BYTES_MAX], bytes[BYTES_MAX];
    size_t counts[2];
    const char *path = scratch_path("fuzz.png");
    for (int kind = 0; kind < 2; kind++) {
        struct display_image image = {
            .width_px = 37, .height_px = 23, .channels = kind ? 3 : 1};
        assert_int_equal(display_image_create(&image), DISPLAY_OK);
        for (int i = 0; i < 37 * 23; i++)
            image.pixels[i] = (uint8_t)sample_below(&random_state, 256);
        assert_int_equal(display_png_write(path, &image), DISPLAY_OK);
        display_image_destroy(&image);
        counts[kind] = file_read(path, whole[kind]);
    }
    int read = 0, refused = 0;
    for (int i = 0; i < MUTATIONS; i++) {
        memcpy(bytes, whole[i % 2], counts[i % 2]);
        size_t count = mutate(bytes, counts[i % 2]);
        if (i % 4 < 2)
            checksums_mend(bytes, count);
        if (header_is_huge(bytes, count))
            continue;
        file_write(path, bytes, count);
        struct display_image image;
        enum display_status status = i % 8 < 4 ? display_png_read_gray(path, &image)
                                               : display_png_read_rgb(path, &image);
        if (status == DISPLAY_OK) {
            read++;
            assert_non_null(image.pixels);
        } else {
            refused++;
            assert_null(image.pixels);
            assert_non_null(strstr(display_error(), path));
            assert_null(strchr(display_error(), '\n'));
        }
        display_image_destroy(&image);
    }
    assert_true(read > 0 && refused > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(damaged_files_are_read_or_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

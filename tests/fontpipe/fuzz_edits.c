/* fuzz_edits.c - folders of edits whose files were changed by chance: each is read and drawn
 * with, or refused in one line. LUTETIA_EDITS_FOLDERS: how many. */
#include "edits_support.h"

#include <display.h>
#include <own.h>
#include <paint.h>

#include <stdlib.h>
#include <string.h>

enum { FILES = 8, BYTES = 1 << 16 };

static const char *const names[FILES] = {
    "edits.txt",          "A.svg",        "B.glif", "C.txt", "D.png", "E-14.png",
    "F-filter-10-20.txt", "A-wdth105.svg"};

struct file {
    uint8_t bytes[BYTES];
    size_t count;
};

static void write_file(const char *folder, const char *name, const struct file *file)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fwrite(file->bytes, 1, file->count, f);
    assert_int_equal(fclose(f), 0);
}

static void read_file(const char *folder, const char *name, struct file *file)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    file->count = fread(file->bytes, 1, BYTES, f);
    fclose(f);
}

/* Bytes are others, are gone, or are there twice; or a number is another. */
static void damage(struct file *file, uint32_t *seed)
{
    static const char *const words[] = {"99999999", "-1", "1e300",    "nan", "/../", "<",
                                        "Z",        "'",  "#",        "\n",  " ",    "M",
                                        "0",        "@",  "wdth=105", ",",   ":",    "-"};
    int times = 1 + (int)random_below(seed, 4);
    while (times--) {
        size_t at = random_below(seed, (uint32_t)file->count + 1), left = file->count - at;
        size_t some = random_below(seed, 12);
        some = some < left ? some : left;
        switch (random_below(seed, 4)) {
        case 0:
            if (left)
                file->bytes[at] = (uint8_t)random_below(seed, 256);
            break;
        case 1:
            memmove(file->bytes + at, file->bytes + at + some, left - some);
            file->count -= some;
            break;
        case 2:
            if (file->count + some < BYTES) {
                memmove(file->bytes + at + some, file->bytes + at, left);
                file->count += some;
            }
            break;
        default: {
            const char *word = words[random_below(seed, sizeof words / sizeof *words)];
            size_t length = strlen(word);
            if (length <= left)
                memcpy(file->bytes + at, word, length);
        }
        }
    }
}

/* A folder with one edit of each kind, none of them as it was written. */
static const char *folder_make(void)
{
    const char *folder = scratch_path("edits");
    assert_int_equal(mkdir(folder, 0777), 0);
    struct font_face *face = wide_face_open(folder);
    const struct font_edits_out what[FILES - 1] = {
        {.glyph = 'A', .ending = ".svg"},
        {.glyph = 'B', .ending = ".glif"},
        {.glyph = 'C', .level = FONT_EDITS_RECTANGLES},
        {.glyph = 'D', .level = FONT_EDITS_MASTER},
        {.glyph = 'E', .level = FONT_EDITS_GRAY},
        {.glyph = 'F', .level = FONT_EDITS_FILTER, .from_px = 10, .to_px = 20},
        {.glyph = 'A', .here = true}};
    for (int i = 0; i < FILES - 1; i++) {
        char file[FONT_EDITS_FILE_BYTES];
        struct font_edits_out out = what[i];
        out.glyph = font_face_glyph(face, out.glyph);
        assert_font(font_face_axis_set(face, "wdth", out.here ? 105 : 100));
        level_out(folder, face, &out, 40, 14, "box", file);
        assert_string_equal(file, names[i + 1]);
    }
    font_face_close(face);
    static struct file list;
    read_file(folder, "edits.txt", &list);
    char *rows = strchr(strstr((char *)list.bytes, "sha256"), '\n');
    for (int i = 1; i < FILES; i++) { /* a sum that no file has */
        char *row = strstr(rows, names[i]);
        assert_non_null(row);
        if (row[strlen(names[i]) + 1] != '-')
            memset(row + strlen(names[i]) + 1, '0', 16);
    }
    write_file(folder, "edits.txt", &list);
    return folder;
}

static bool drawn_with(const char *folder)
{
    struct font_face *face;
    enum font_status status = font_edits_open(folder, 0, false, &face);
    if (status != FONT_OK) {
        assert_null(face);
        assert_true(font_error()[0] && !strchr(font_error(), '\n'));
        return false;
    }
    struct font_painter_def def = font_painter_def_default();
    struct font_painter *painter;
    struct font_layout layout;
    struct font_shaper *shaper = shaper_make(face);
    static uint8_t gray[100 * 40];
    struct font_cover cover = {100, 40, 100, gray};
    assert_font(font_painter_create(&def, &painter));
    assert_font(font_shaper_layout(shaper, "ABCDEF", 6, 14, NULL, &layout));
    (void)font_painter_cover(painter, &layout, NULL, 5, 30, &cover); /* or one line */
    font_layout_finish(&layout);
    assert_font(font_face_axis_set(face, "wdth", 105));
    assert_font(font_shaper_layout(shaper, "ABCDEF", 6, 14, NULL, &layout));
    (void)font_painter_cover(painter, &layout, NULL, 5, 30, &cover);
    font_layout_finish(&layout);
    font_painter_destroy(painter);
    font_shaper_destroy(shaper);
    font_face_close(face);
    (void)font_edits_said();
    return true;
}

static void damaged_folders_are_used_or_refused(void **state)
{
    (void)state;
    static struct file whole[FILES], copy;
    const char *many = getenv("LUTETIA_EDITS_FOLDERS");
    int count = many ? atoi(many) : 250, used = 0;
    const char *made = folder_make();
    char folder[512];
    snprintf(folder, sizeof folder, "%s", made);
    for (int i = 0; i < FILES; i++)
        read_file(folder, names[i], &whole[i]);
    assert_true(drawn_with(folder));
    uint32_t seed = 1990;
    for (int i = 0; i < count; i++) {
        int which = (int)random_below(&seed, FILES);
        copy = whole[which];
        damage(&copy, &seed);
        write_file(folder, names[which], &copy);
        used += drawn_with(folder);
        write_file(folder, names[which], &whole[which]);
    }
    print_message("%d of %d folders could be used\n", used, count);
    assert_true(used > count / 20 && used < count);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(damaged_folders_are_used_or_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

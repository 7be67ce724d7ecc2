/* fuzz_remarks.c - takes random bytes as a kept anchor, and as a file of remarks; and a valid
 * file with bytes changed. What is read is whole, and HTML and pages can be made of it; or it
 * is refused with a line. The seeds are the same in every run, or libFuzzer's with
 * -DLUTETIA_FUZZ_TARGET. */
#include <reader_html.h>
#include <reader_pages.h>

#include "../must.h"
#include "html_tags.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static const char plain[] =
    "# A\n\nThe river ran slowly, and the reeds stood in it. The river ran.\n\n";
static char path[] = "/tmp/lutetia-fuzz-remarks-XXXXXX";

static void path_make(void)
{
    static bool made;
    if (!made) {
        const int file = mkstemp(path);
        must(file >= 0);
        close(file);
        made = true;
    }
}

static void anchor_check(const struct reader_anchor *anchor)
{
    size_t begin = 0, end = 0, quoted;
    must(reader_anchor_quotation(anchor, &quoted) != NULL);
    must(reader_anchor_headings(anchor) != NULL);
    if (reader_anchor_find(anchor, plain, sizeof plain - 1, &begin, &end) ==
        READER_ANCHOR_MOVED)
        must(begin <= end && end <= sizeof plain - 1);
}

/* HTML with them is whole. */
static void html_try(const struct reader_document *d, const struct reader_remarks *remarks)
{
    char *html = NULL;
    size_t bytes = 0;
    FILE *f = open_memstream(&html, &bytes);
    must(f != NULL);
    must(reader_html_write(d, &(struct reader_html_setup){.remarks = remarks}, f) == READER_OK);
    must(fclose(f) == 0 && html_wrong(html) == NULL);
    free(html);
}

/* Pages with them are drawings. */
static void pages_try(const struct reader_document *d, const struct reader_remarks *remarks)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct reader_pages *pages;
    int count;
    setup.font = "DejaVuSans";
    setup.remarks = remarks;
    must(reader_pages_make(d, &setup, &pages) == READER_OK);
    must(page_count(reader_pages_text(pages), &count) == FONT_OK && count > 0);
    for (int page = 0; page < count; page++) {
        struct font_drawing drawing = {.width_px = setup.width_px,
                                       .height_px = setup.height_px};
        struct font_layout layout;
        char *pdf = NULL;
        size_t bytes = 0;
        FILE *f = open_memstream(&pdf, &bytes);
        must(f && page_layout(reader_pages_text(pages), page, &layout) == FONT_OK);
        must(reader_pages_left(pages, page, &drawing) == READER_OK);
        must(font_drawing_pdf(&drawing, &layout, NULL, 0, 0, f) == FONT_OK);
        must(fclose(f) == 0 && !memmem(pdf, bytes, "nan", 3) && !memmem(pdf, bytes, "inf ", 4));
        free(pdf);
        font_layout_finish(&layout);
    }
    reader_pages_destroy(pages);
}

static void exported_try(const struct reader_remarks *remarks)
{
    static struct reader_document *d;
    static bool without;
    if (!d && !without) {
        must(reader_document_create(&d) == READER_OK);
        without = reader_document_add(d, plain, sizeof plain - 1) != READER_OK;
        must(without || reader_document_refer(d) == READER_OK);
        must(without || reader_document_plain(d) == READER_OK);
        must(without || strcmp(d->plain, plain) == 0);
    }
    if (without)
        return;
    html_try(d, remarks);
    pages_try(d, remarks);
}

static void file_try(const uint8_t *bytes, size_t count)
{
    struct reader_remarks *remarks;
    FILE *file = fopen(path, "wb");
    must(file && fwrite(bytes, 1, count, file) == count && fclose(file) == 0);
    if (reader_remarks_open(path, &remarks) != READER_OK) {
        must(strstr(reader_error(), path));
        return;
    }
    for (int i = 0; i < reader_remarks_count(remarks); i++) {
        const struct reader_remark *r = reader_remarks_get(remarks, i);
        must(r->layer >= 0 && r->layer < reader_remarks_layers(remarks) && r->by);
        must(r->text && r->anchor && (r->points_count == 0 || r->points));
        must(r->scale_x > 0 && r->scale_y > 0 && r->hangs >= 0 && r->group >= -1);
        must(r->hangs < reader_remarks_count(remarks) &&
             r->group < reader_remarks_count(remarks));
        anchor_check(r->anchor);
    }
    reader_remarks_find(remarks, plain, sizeof plain - 1);
    exported_try(remarks);
    reader_remarks_close(remarks);
}

/* A file of four remarks, made once. */
static const uint8_t *valid_file(size_t *count)
{
    static uint8_t *bytes;
    static size_t length;
    struct reader_remarks *remarks;
    struct reader_ink_point points[3] = {{0, 0, 0.5f, 0}, {1, 1, 0.7f, 0.1f}, {2, 0, 1, 0.2f}};
    char words[] = "words";
    const struct reader_remark what[] = {
        {.kind = READER_REMARK_INK, .points = points, .points_count = 2, .width = 1},
        {.kind = READER_REMARK_INK, .points = points, .points_count = 3, .width = 1},
        {.kind = READER_REMARK_TYPED, .text = words},
        {.kind = READER_REMARK_HIGHLIGHT}};
    struct reader_arranged to[2];
    int index;
    *count = length;
    if (bytes)
        return bytes;
    unlink(path);
    must(reader_remarks_open(path, &remarks) == READER_OK);
    for (size_t i = 0; i < sizeof what / sizeof *what; i++) {
        if (i == 2) { /* the others are another reader's */
            must(reader_remarks_layer_add(remarks, "Anna", &index) == READER_OK);
            reader_remarks_write_layer(remarks, index);
        }
        must(reader_remarks_add(remarks, &what[i], plain, sizeof plain - 1, 5 + i, 14 + i,
                                &index) == READER_OK);
        if (i != 1)
            continue;
        for (int k = 0; k < 2; k++) { /* both are a group, and scaled */
            to[k] = reader_remarks_arranged(remarks, k);
            to[k].scale_x = 2;
            to[k].hangs = to[k].group = 0;
        }
        must(reader_remarks_arrange(remarks, to, 2) == READER_OK);
    }
    reader_remarks_close(remarks);
    FILE *file = fopen(path, "rb");
    must(file && fseek(file, 0, SEEK_END) == 0);
    length = (size_t)ftell(file);
    rewind(file);
    bytes = malloc(length);
    must(bytes && fread(bytes, 1, length, file) == length);
    fclose(file);
    *count = length;
    return bytes;
}

/* Numbers of three bytes, two for the place and one for the value, change the valid file. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct reader_anchor *anchor;
    size_t length;
    path_make();
    if (count < 1)
        return 0;
    if (reader_anchor_restore(bytes, count, &anchor) == READER_OK) {
        anchor_check(anchor);
        reader_anchor_destroy(anchor);
    }
    if (bytes[0] % 4 == 0) {
        file_try(bytes + 1, count - 1);
        return 0;
    }
    const uint8_t *valid = valid_file(&length);
    uint8_t *changed = malloc(length);
    must(changed);
    memcpy(changed, valid, length);
    for (size_t i = 1; i + 2 < count; i += 3)
        changed[((size_t)bytes[i] << 8 | bytes[i + 1]) % length] = bytes[i + 2];
    file_try(changed, bytes[0] % 4 == 1 ? (size_t)bytes[0] * length / 255 : length);
    free(changed);
    return 0;
}

#ifndef LUTETIA_FUZZ_TARGET
#include "../sample.h"

/* A kept anchor of which some bytes are changed. */
static void anchors_try(uint64_t *random)
{
    struct reader_anchor *anchor;
    unsigned char *kept;
    size_t count;
    must(reader_anchor_make(plain, sizeof plain - 1, 9, 20, &anchor) == READER_OK);
    must(reader_anchor_keep(anchor, &kept, &count) == READER_OK);
    reader_anchor_destroy(anchor);
    must(reader_anchor_restore(kept, count, &anchor) == READER_OK);
    reader_anchor_destroy(anchor);
    for (int k = 0; k < 1 + (int)(sample_word(random) % 3); k++)
        kept[sample_word(random) % count] = (unsigned char)sample_word(random);
    if (reader_anchor_restore(kept, count - sample_word(random) % 2, &anchor) == READER_OK) {
        anchor_check(anchor);
        reader_anchor_destroy(anchor);
    }
    free(kept);
}

int main(int argc, char **argv)
{
    const long count = argc > 1 ? strtol(argv[1], NULL, 10) : 400;
    uint64_t random = 1;
    for (long i = 0; i < count; i++) {
        uint8_t bytes[64];
        const size_t length = 1 + sample_word(&random) % sizeof bytes;
        for (size_t k = 0; k < length; k++)
            bytes[k] = (uint8_t)sample_word(&random);
        LLVMFuzzerTestOneInput(bytes, length);
        anchors_try(&random);
    }
    unlink(path);
    printf("%ld files of remarks\n", count);
    return 0;
}
#endif

/* fuzz_pages.c - takes random bytes as texts, sets them with random options, edits them and
 * asks for places in them. Each is set or refused. The seeds are the same in every run, or
 * libFuzzer's with -DLUTETIA_FUZZ_TARGET. (security.md 7) */
#include <page.h>
#include <setup.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static const double shape[] = {60, 40, 140, 60, 120, 160, 40, 120};

/* The first bytes are the options, the rest is the text. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    enum { CHOICES = 10, PAGES = 4 };
    struct page_text *text;
    if (count < CHOICES || count > 6000)
        return 0;
    struct page_setup setup = page_setup_default();
    const struct page_shape around = {.points = shape,
                                      .points_count = 4,
                                      .inside = bytes[0] & 1,
                                      .distance_px = bytes[0] >> 4};
    setup.font = "DejaVuSans";
    setup.italic = setup.bold = "DejaVuSans-Bold";
    setup.width_px = 40 + 2 * bytes[1];
    setup.height_px = 40 + 2 * bytes[2];
    setup.margin_px = bytes[3] % 40;
    setup.size_px = 1 + bytes[4] % 40;
    setup.columns = 1 + bytes[5] % 3;
    setup.gap_px = bytes[5] >> 3;
    setup.align = (enum font_align)(bytes[6] % 5);
    setup.hyphenate = bytes[6] & 8;
    setup.vertical = bytes[6] & 16;
    setup.protrude = bytes[6] >> 7;
    setup.expand = (bytes[7] & 3) * 0.01;
    setup.notes_px = bytes[7] & 4 ? 20 : 0;
    setup.shapes = &around;
    setup.shapes_count = bytes[7] & 8 ? 1 : 0;
    setup.language = bytes[7] & 16 ? "en" : NULL;
    if (page_setup_make(&setup, (const char *)bytes + CHOICES, count - CHOICES, &text) !=
        FONT_OK)
        return 0;
    for (int page = 0; page < PAGES; page++) {
        struct font_layout layout;
        struct page_place place, end;
        bool before;
        if (page_layout(text, page, &layout) != FONT_OK)
            break;
        font_layout_finish(&layout);
        if (page_hit(text, page, bytes[8], bytes[9], &place, &before) == FONT_OK) {
            struct page_caret caret;
            struct page_box boxes[8];
            int boxes_count;
            end = place;
            for (int i = 0; i < bytes[9] % 20; i++)
                page_place_step(text, &end, true);
            page_caret_get(text, place, before, &caret);
            page_select(text, place, end, page, boxes, 8, &boxes_count);
            page_text_replace(text, place.paragraph, place.byte, end.byte - place.byte,
                              (const char *)bytes + CHOICES, count > 40 ? 20 : 0);
        }
    }
    page_text_destroy(text);
    return 0;
}

#ifndef LUTETIA_FUZZ_TARGET
int main(int argc, char **argv)
{
    static const char *const pieces[] = {"water ",
                                         "# ",
                                         "\n\n",
                                         "*",
                                         "**",
                                         "[^",
                                         "]",
                                         "[>",
                                         "\\",
                                         "\t",
                                         "\xd8\xa7\xd9\x84 ",
                                         "\xe4\xb8\x80",
                                         "\xe0\xb8\xa0\xe0\xb8\xb2",
                                         "\xf0\x9f\x87\xa9",
                                         "\xff",
                                         "extraordinary ",
                                         "\xc2\xad",
                                         "\xe2\x80\x8f",
                                         "e\xcc\x81",
                                         "\xe2\x80\xa8"};
    int turns = argc > 1 ? atoi(argv[1]) : 300;
    uint32_t seed = argc > 2 ? (uint32_t)atoi(argv[2]) : 1;
    for (int turn = 0; turn < turns; turn++) {
        uint8_t bytes[6000];
        size_t count = 0;
        for (; count < 10; count++)
            bytes[count] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
        int words = (int)((seed = seed * 1664525u + 1013904223u) >> 24);
        for (int i = 0; i < words; i++) {
            seed = seed * 1664525u + 1013904223u;
            const char *piece = pieces[(seed >> 16) % (sizeof pieces / sizeof *pieces)];
            memcpy(bytes + count, piece, strlen(piece));
            count += strlen(piece);
            if (seed >> 30 == 0)
                bytes[count++] = (uint8_t)(seed >> 8);
        }
        LLVMFuzzerTestOneInput(bytes, count);
    }
    printf("%d texts\n", turns);
    return 0;
}
#endif

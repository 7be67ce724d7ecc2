/* page_texts.c - see page_texts.h. */
#include "page_texts.h"

#include <string.h>

static const char *const words[] = {"water",
                                    "the",
                                    "of",
                                    "paper,",
                                    "printer",
                                    "difficult.",
                                    "fi",
                                    "waffles",
                                    "AVATAR",
                                    "\xd8\xa7\xd9\x84\xd9\x85\xd8\xa7\xd8\xa1",
                                    "\xd7\x9e\xd7\x99\xd7\x9d",
                                    "\xd0\xb2\xd0\xbe\xd0\xb4\xd0\xb0",
                                    "\xce\xbd\xce\xb5\xcf\x81\xcf\x8c",
                                    "e\xcc\x81l\xc3\xa8ve",
                                    "extraordinary",
                                    "(brackets)",
                                    "1990",
                                    "co-operate",
                                    ("un\xc2\xad"
                                     "seen"),
                                    "\xe2\x80\x9cquoted\xe2\x80\x9d",
                                    "\xd8\xa8\xd9\x90\xd8\xb3\xd9\x92\xd9\x85",
                                    "a\tb",
                                    "line\nend",
                                    "\xe0\xb8\x99\xe0\xb9\x89\xe0\xb8\xb3",
                                    "\xf0\x9f\x98\x80\xf0\x9f\x87\xa9\xf0\x9f\x87\xaa",
                                    "\xe4\xb8\x80\xe4\xba\x8c\xe4\xb8\x89",
                                    "\xff"};
uint32_t page_words_used = sizeof words / sizeof *words;

size_t page_random_text(uint32_t *seed, char *out, int count)
{
    size_t bytes = 0;
    for (int i = 0; i < count; i++) {
        const char *w = words[random_next(seed) % page_words_used];
        memcpy(out + bytes, w, strlen(w));
        bytes += strlen(w);
        if (i + 1 < count)
            out[bytes++] = ' ';
    }
    return bytes;
}

struct page_text *page_text_begin(void)
{
    struct page_text *t;
    assert_font(page_text_create(&t));
    for (int i = 0; i < PAGE_STYLES; i++) {
        static const char *const fonts[PAGE_STYLES] = {
            "DejaVuSerif", "DejaVuSans", "EBGaramond12-Italic", "DejaVuSans-Bold"};
        struct page_style style = page_style_default();
        int id;
        style.font = fonts[i];
        style.size_px = 10 + 3 * i;
        style.language = "en";
        style.inked = i == 3;
        style.ink = font_ink_plain(1, 0, 0, 0.5);
        style.raise_px = i == 1 ? 2 : 0;
        assert_font(page_style_add(t, &style, &id));
        assert_int_equal(id, i);
    }
    return t;
}

struct page_manner page_random_manner(uint32_t *seed)
{
    struct page_manner m = page_manner_default();
    m.align = (enum font_align)(random_next(seed) % 5);
    m.hyphenate = random_next(seed) % 2;
    m.protrude = random_next(seed) % 2;
    m.expand = random_next(seed) % 3 ? 0 : 0.02;
    m.indent_px = random_next(seed) % 2 * 12;
    m.before_px = random_next(seed) % 3 * 4;
    m.keep_with_next = random_next(seed) % 6 == 0;
    m.keep_together = random_next(seed) % 6 == 0;
    m.begins_column = random_next(seed) % 12 == 0;
    m.begins_page = random_next(seed) % 12 ? 0 : 1 + (int)(random_next(seed) % 4);
    m.page_depth_px = m.begins_page && random_next(seed) % 2 ? 90 : 0;
    m.leading_px = random_next(seed) % 4 ? 18 : 0; /* 0: the faces' own */
    m.tabs[0] = (struct page_tab){60, PAGE_TAB_RIGHT};
    m.tabs_count = 1;
    return m;
}

/* html_letters.c - letters that are no tags: see html_internal.h. */
#include "html_internal.h"

#include <string.h>
#include <text.h>

void html_put(struct html *h, const char *text, size_t bytes)
{
    const char *const end = text + bytes;
    while (text < end) {
        char utf8[FONT_UTF8_BYTES];
        uint32_t c;
        font_utf8_next(&text, end, &c);
        if (c == '<')
            fputs("&lt;", h->f);
        else if (c == '>')
            fputs("&gt;", h->f);
        else if (c == '&')
            fputs("&amp;", h->f);
        else if (c == '"')
            fputs("&quot;", h->f);
        else if ((c >= 0x20 && (c < 0x7f || c > 0x9f)) || c == '\n' || c == '\t')
            fwrite(utf8, 1, (size_t)font_utf8_put(c, utf8), h->f);
    }
}

void html_puts(struct html *h, const char *text)
{
    html_put(h, text, strlen(text));
}

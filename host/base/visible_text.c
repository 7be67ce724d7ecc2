/* visible_text.c - see visible_text.h. */
#include "visible_text.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Reads the first character of the text and returns its number of bytes; 0 bytes if it is
 * not UTF-8. */
static size_t character_read(const unsigned char *text, size_t length, uint32_t *out)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    unsigned char first = text[0];
    size_t bytes = first < 0x80         ? 1
                   : first >> 5 == 0x06 ? 2
                   : first >> 4 == 0x0e ? 3
                   : first >> 3 == 0x1e ? 4
                                        : 0;
    if (bytes == 0 || bytes > length)
        return 0;
    *out = bytes == 1 ? first : first & (0x7fu >> bytes);
    for (size_t i = 1; i < bytes; i++) {
        if (text[i] >> 6 != 2)
            return 0;
        *out = *out << 6 | (text[i] & 0x3f);
    }
    bool surrogate = *out >= 0xd800 && *out <= 0xdfff;
    return *out < least[bytes] || *out > 0x10ffff || surrogate ? 0 : bytes;
}

/* Control characters, and characters that are invisible or change how others are shown. */
static bool is_invisible(uint32_t c)
{
    static const struct {
        uint32_t first, last;
    } ranges[] = {
        {0x80, 0x9f},     {0xad, 0xad},       {0x61c, 0x61c},   {0x180e, 0x180e},
        {0x200b, 0x200f}, {0x2028, 0x202e},   {0x2060, 0x206f}, {0xfeff, 0xfeff},
        {0xfff0, 0xfffb}, {0xe0000, 0xe0fff},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (c >= ranges[i].first && c <= ranges[i].last)
            return true;
    return false;
}

static size_t text_pass(char *out, size_t size, const char *text, size_t length, bool lines)
{
    size_t used = 0;
    if (size == 0)
        return 0;
    for (size_t at = 0; at < length;) {
        const unsigned char *from = (const unsigned char *)text + at;
        char shown[16];
        uint32_t c = 0;
        size_t bytes = character_read(from, length - at, &c), room;
        if (bytes == 0 || c < ' ' || c == 127) {
            bool gap = bytes && (c == '\n' || c == '\r' || c == '\t');
            if (bytes && lines && (c == '\n' || c == '\t'))
                room = (size_t)snprintf(shown, sizeof shown, "%c", (int)c);
            else if (gap && !lines)
                room = (size_t)snprintf(shown, sizeof shown, " ");
            else
                room = (size_t)snprintf(shown, sizeof shown, "\\x%02x", *from);
            bytes = 1;
        } else if (is_invisible(c)) {
            room = (size_t)snprintf(shown, sizeof shown, "\\u{%04x}", (unsigned)c);
        } else {
            memcpy(shown, from, bytes);
            room = bytes;
        }
        if (room > size - 1 - used)
            break;
        memcpy(out + used, shown, room);
        used += room;
        at += bytes;
    }
    out[used] = '\0';
    return used;
}

size_t visible_text(char *out, size_t size, const char *text)
{
    return text_pass(out, size, text, strlen(text), false);
}

void visible_say(const char *format, ...)
{
    char text[2400], line[2 * sizeof text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    visible_text(line, sizeof line, text);
    fprintf(stderr, "%s\n", line);
}

void visible_print(const char *format, ...)
{
    char text[4096], shown[2 * sizeof text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fwrite(shown, 1, visible_text_lines(shown, sizeof shown, text, strlen(text)), stdout);
}

size_t visible_text_lines(char *out, size_t size, const char *text, size_t length)
{
    return text_pass(out, size, text, length, true);
}

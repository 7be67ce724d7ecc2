/* tag.c - the tags of HTML that are read: see tag.h and
 * reader_internal.h. */
#include "tag.h"
#include "reader_internal.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <text.h>

const char *reader_tag_label(const char *tag, size_t *bytes)
{
    const char *at = strncmp(tag, "<a ", 3) == 0 ? tag + 3 + strspn(tag + 3, " \n") : "";
    at += strncmp(at, "id=", 3) == 0 ? 3 : strncmp(at, "name=", 5) == 0 ? 5 : strlen(at);
    const char quote = *at == '"' || *at == '\'' ? *at++ : '\0';
    *bytes = strcspn(at, " \t\n\"'<>=`#");
    const char *end = at + *bytes;
    if (quote && *end++ != quote)
        return NULL;
    end += strspn(end, " \n");
    return *bytes >= 1 && *bytes <= READER_LABEL_BYTES && strcmp(end, ">") == 0 ? at : NULL;
}

const char *reader_tag_break(const char *text)
{
    const char *at = text + 3;
    if (strncasecmp(text, "<br", 3) != 0)
        return text;
    at += strspn(at, " \t");
    at += *at == '/';
    return *at == '>' ? at + 1 : text;
}

/* ---- what tags mean ---- */

static const struct {
    const char *name;
    enum tag_kind kind;
    int level;
    unsigned look;
} known[] = {{"p", TAG_PARAGRAPH, 0, 0},
             {"div", TAG_DIVISION, 0, 0},
             {"center", TAG_CENTER, 0, 0},
             {"h1", TAG_HEADING, 1, 0},
             {"h2", TAG_HEADING, 2, 0},
             {"h3", TAG_HEADING, 3, 0},
             {"h4", TAG_HEADING, 4, 0},
             {"h5", TAG_HEADING, 5, 0},
             {"h6", TAG_HEADING, 6, 0},
             {"blockquote", TAG_QUOTE, 0, 0},
             {"details", TAG_DETAILS, 0, 0},
             {"summary", TAG_SUMMARY, 0, READER_HEAVY},
             {"ul", TAG_LIST, 0, 0},
             {"ol", TAG_LIST, 1, 0},
             {"li", TAG_ITEM, 0, 0},
             {"table", TAG_TABLE, 0, 0},
             {"tr", TAG_ROW, 0, 0},
             {"td", TAG_CELL, 0, 0},
             {"th", TAG_CELL, 1, 0},
             {"thead", TAG_PLAIN, 0, 0},
             {"tbody", TAG_PLAIN, 0, 0},
             {"img", TAG_PICTURE, 0, 0},
             {"a", TAG_LINK, 0, 0},
             {"br", TAG_BREAK, 0, 0},
             {"hr", TAG_RULE, 0, 0},
             {"b", TAG_LOOK, 0, READER_HEAVY},
             {"strong", TAG_LOOK, 0, READER_HEAVY},
             {"i", TAG_LOOK, 0, READER_SLANTED},
             {"em", TAG_LOOK, 0, READER_SLANTED},
             {"var", TAG_LOOK, 0, READER_SLANTED},
             {"cite", TAG_LOOK, 0, READER_SLANTED},
             {"dfn", TAG_LOOK, 0, READER_SLANTED},
             {"s", TAG_LOOK, 0, READER_STRUCK},
             {"del", TAG_LOOK, 0, READER_STRUCK},
             {"strike", TAG_LOOK, 0, READER_STRUCK},
             {"code", TAG_LOOK, 0, READER_CODE},
             {"kbd", TAG_LOOK, 0, READER_CODE},
             {"samp", TAG_LOOK, 0, READER_CODE},
             {"tt", TAG_LOOK, 0, READER_CODE},
             {"sub", TAG_LOOK, 0, READER_LOWERED},
             {"sup", TAG_LOOK, 0, READER_RAISED},
             {"span", TAG_PLAIN, 0, 0},
             {"font", TAG_PLAIN, 0, 0},
             {"small", TAG_PLAIN, 0, 0},
             {"big", TAG_PLAIN, 0, 0},
             {"u", TAG_PLAIN, 0, 0},
             {"ins", TAG_PLAIN, 0, 0},
             {"abbr", TAG_PLAIN, 0, 0},
             {"nobr", TAG_PLAIN, 0, 0},
             {"wbr", TAG_PLAIN, 0, 0},
             {"picture", TAG_PLAIN, 0, 0},
             {"source", TAG_PLAIN, 0, 0}};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

static const char *blanks_skip(const char *at)
{
    while (is_blank(*at))
        at++;
    return at;
}

/* An attribute: where its name and its value are; false: there is none, or it is broken. */
static bool attribute_next(const char **at, const char **name, int *name_bytes,
                           const char **value, int *value_bytes)
{
    const char *s = blanks_skip(*at);
    *name = s;
    while (*s && !is_blank(*s) && !strchr("\"'<>/=", *s))
        s++;
    *name_bytes = (int)(s - *name);
    *value = s;
    *value_bytes = 0;
    const char *sign = blanks_skip(s);
    if (*name_bytes && *sign == '=') {
        s = blanks_skip(sign + 1);
        const char quote = *s == '"' || *s == '\'' ? *s++ : '\0';
        *value = s;
        while (*s && (quote ? *s != quote : !is_blank(*s) && !strchr("\"'=<>`", *s)))
            s++;
        *value_bytes = (int)(s - *value);
        if (quote && *s++ != quote)
            return false;
    }
    *at = s;
    return *name_bytes > 0;
}

static void meaning_find(const char *name, size_t bytes, struct tag *out)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strlen(known[i].name) == bytes && strncasecmp(known[i].name, name, bytes) == 0) {
            out->kind = known[i].kind;
            out->level = known[i].level;
            out->look = known[i].look;
        }
}

bool tag_read(const char *text, struct tag *out)
{
    *out = (struct tag){.at = text};
    if (strncmp(text, "<!--", 4) == 0) {
        const char *end = strstr(text + 4, "-->");
        out->kind = TAG_COMMENT;
        out->bytes = (int)(end ? (size_t)(end + 3 - text) : strlen(text));
        return true;
    }
    out->closing = text[0] == '<' && text[1] == '/';
    const char *name = text + 1 + out->closing, *at = name;
    if (text[0] != '<' || (!isalpha((unsigned char)*name) && !strchr("!?", *name)) || !*name)
        return false;
    while (isalnum((unsigned char)*at) || *at == '-')
        at++;
    const size_t bytes = (size_t)(at - name);
    const char *of, *value;
    int of_bytes, value_bytes;
    while (attribute_next(&at, &of, &of_bytes, &value, &value_bytes) && !out->closing)
        ;
    at = blanks_skip(at);
    at += *at == '/' && !out->closing;
    if (*at != '>')
        return *name == '!' || *name == '?'; /* unknown, wherever it ends */
    out->bytes = (int)(at + 1 - text);
    meaning_find(name, bytes, out);
    return true;
}

bool tag_is_block(const struct tag *tag)
{
    switch (tag->kind) {
    case TAG_RULE:
    case TAG_PARAGRAPH:
    case TAG_DIVISION:
    case TAG_CENTER:
    case TAG_HEADING:
    case TAG_QUOTE:
    case TAG_DETAILS:
    case TAG_SUMMARY:
    case TAG_LIST:
    case TAG_ITEM:
    case TAG_TABLE:
    case TAG_ROW:
    case TAG_CELL:
        return true;
    case TAG_UNKNOWN:
    case TAG_COMMENT:
    case TAG_BREAK:
    case TAG_PICTURE:
    case TAG_LINK:
    case TAG_LOOK:
    case TAG_PLAIN:
        break;
    }
    return false;
}

/* ---- what they say ---- */

char *tag_attribute(const struct tag *tag, const char *wanted)
{
    const char *at = tag->at + 1, *name, *value;
    int name_bytes, value_bytes;
    while (isalnum((unsigned char)*at) || *at == '-')
        at++;
    while (!tag->closing && at < tag->at + tag->bytes &&
           attribute_next(&at, &name, &name_bytes, &value, &value_bytes)) {
        if (strlen(wanted) != (size_t)name_bytes ||
            strncasecmp(name, wanted, (size_t)name_bytes) != 0)
            continue;
        char *copy = strndup(value, (size_t)value_bytes);
        if (copy)
            tag_entities(copy);
        return copy;
    }
    return NULL;
}

enum reader_align tag_align(const struct tag *tag)
{
    static const char *const names[] = {"", "left", "center", "right"};
    enum reader_align align =
        tag->kind == TAG_CENTER ? READER_ALIGN_CENTER : READER_ALIGN_USUAL;
    char *said = tag_attribute(tag, "align");
    for (int i = READER_ALIGN_LEFT; said && i <= READER_ALIGN_RIGHT; i++)
        align = strcasecmp(said, names[i]) == 0 ? (enum reader_align)i : align;
    free(said);
    return align;
}

/* A number of pixels, or of percent; 0: it is none. */
static short side_of(const struct tag *tag, const char *name, short *percent)
{
    enum { PIXELS_MOST = 10000 };
    char *said = tag_attribute(tag, name), *end = said;
    const long value = said && isdigit((unsigned char)*said) ? strtol(said, &end, 10) : 0;
    const bool part = said && *end == '%' && !end[1],
               pixels = said && end != said && (!*end || strcmp(end, "px") == 0);
    free(said);
    if (part && percent)
        *percent = value >= 1 && value <= 100 ? (short)value : 0;
    return pixels && value > 0 && value <= PIXELS_MOST ? (short)value : 0;
}

struct reader_asked tag_asked(const struct tag *tag)
{
    struct reader_asked asked = {0};
    asked.width_px = side_of(tag, "width", &asked.percent);
    asked.height_px = side_of(tag, "height", NULL);
    return asked;
}

/* ---- entities ---- */

static const struct {
    const char *name;
    uint32_t letter;
} entities[] = {{"amp", '&'},      {"lt", '<'},        {"gt", '>'},       {"quot", '"'},
                {"apos", '\''},    {"nbsp", 0xa0},     {"copy", 0xa9},    {"reg", 0xae},
                {"laquo", 0xab},   {"raquo", 0xbb},    {"deg", 0xb0},     {"middot", 0xb7},
                {"times", 0xd7},   {"ensp", 0x2002},   {"emsp", 0x2003},  {"thinsp", 0x2009},
                {"ndash", 0x2013}, {"mdash", 0x2014},  {"lsquo", 0x2018}, {"rsquo", 0x2019},
                {"ldquo", 0x201c}, {"rdquo", 0x201d},  {"bull", 0x2022},  {"hellip", 0x2026},
                {"trade", 0x2122}, {"larr", 0x2190},   {"uarr", 0x2191},  {"rarr", 0x2192},
                {"darr", 0x2193},  {"hearts", 0x2665}, {"check", 0x2713}};

/* The letter that a text from '&' on tells, and its length; 0: it tells none. */
static uint32_t entity_read(const char *text, int *bytes)
{
    const int name = (int)strspn(text + 1, "#0123456789abcdefghijklmnopqrstuvwxyz"
                                           "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    *bytes = name + 2;
    if (name < 1 || name > 10 || text[1 + name] != ';')
        return 0;
    if (text[1] == '#') {
        const bool hex = text[2] == 'x' || text[2] == 'X';
        const char *digits = text + (hex ? 3 : 2);
        char *end;
        const unsigned long value =
            isxdigit((unsigned char)*digits) ? strtoul(digits, &end, hex ? 16 : 10) : 0;
        const bool good =
            value >= 0x20 && value <= 0x10ffff && !(value >= 0xd800 && value < 0xe000);
        if (!isxdigit((unsigned char)*digits) || end != text + 1 + name)
            return 0;
        return good ? (uint32_t)value : 0xfffd;
    }
    for (size_t i = 0; i < sizeof entities / sizeof *entities; i++)
        if (strlen(entities[i].name) == (size_t)name &&
            strncmp(entities[i].name, text + 1, (size_t)name) == 0)
            return entities[i].letter;
    return 0;
}

void tag_entities(char *text)
{
    char *to = text;
    for (const char *at = text; *at;) {
        int bytes;
        const uint32_t letter = *at == '&' ? entity_read(at, &bytes) : 0;
        if (letter) {
            to += font_utf8_put(letter, to);
            at += bytes;
        } else {
            *to++ = *at++;
        }
    }
    *to = '\0';
}

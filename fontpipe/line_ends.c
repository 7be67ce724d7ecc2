/* line_ends.c - where lines may end: by ICU, which knows Unicode's present rules and the words
 * of Thai, Lao, Khmer and Burmese, or, where it is not installed, by libunibreak, whose tables
 * are of Unicode 6.
 *
 * ICU is large (its data alone 30 MB), and most text needs nothing of it: of plain letters,
 * white space and usual signs both say the same (tests/fontpipe/test_unicode.c). So it is
 * loaded when the first paragraph comes that has more. */
#include "text_internal.h"

#include <library.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <linebreak.h>
#include <unicode/ubrk.h>
#include <unicode/uchar.h>

/* ---- libunibreak ---- */

__attribute__((constructor)) static void unibreak_begin(void)
{
    init_linebreak(); /* an index to its tables */
}

/* What libunibreak is given for a character: it stops the program at flags, and emoji are
 * unknown to it. */
static uint32_t known_to_unibreak(uint32_t c)
{
    enum { IDEOGRAPH = 0x4e00, MARK = 0x308, UNKNOWN = 0xfffd };
    bool flag = c >= 0x1f1e6 && c <= 0x1f1ff, modifier = c >= 0x1f3fb && c <= 0x1f3ff;
    bool emoji = c >= 0x1f300 && c <= 0x1faff;
    return modifier ? MARK : flag || emoji ? IDEOGRAPH : (c & 0xfffe) == 0xfffe ? UNKNOWN : c;
}

static bool by_unibreak(const uint32_t *characters, int count, const char *language,
                        char *breaks)
{
    uint32_t *known = calloc((size_t)count + 1, sizeof *known);
    int flags = 0; /* regional indicators in a row: two are one flag */
    if (!known)
        return false;
    for (int i = 0; i < count; i++)
        known[i] = known_to_unibreak(characters[i]);
    set_linebreaks_utf32(known, (size_t)count, language, breaks);
    for (int i = 0; i + 1 < count; i++) {
        flags = characters[i] >= 0x1f1e6 && characters[i] <= 0x1f1ff ? flags + 1 : 0;
        bool half = flags % 2 && characters[i + 1] >= 0x1f1e6 && characters[i + 1] <= 0x1f1ff;
        bool joins = characters[i] == 0x200d;
        if ((half || joins) && breaks[i] == LINEBREAK_ALLOWBREAK)
            breaks[i] = LINEBREAK_NOBREAK;
    }
    free(known);
    return true;
}

/* ---- ICU ---- */

enum { LANGUAGES_MAX = 16 };

static struct {
    UBreakIterator *(*open)(UBreakIteratorType, const char *, const UChar *, int32_t,
                            UErrorCode *);
    void (*close)(UBreakIterator *);
    void (*text_set)(UBreakIterator *, const UChar *, int32_t, UErrorCode *);
    int32_t (*next)(UBreakIterator *);
    int32_t (*status)(UBreakIterator *);
    int32_t (*property)(UChar32, UProperty);
} icu;
static bool icu_there;
static int icu_version;

static struct {
    char language[16];
    UBreakIterator *iterator;
} iterators[LANGUAGES_MAX];
static int iterators_count;
static pthread_mutex_t icu_lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t icu_once = PTHREAD_ONCE_INIT;

/* Its functions have its version in their names, as the library has in its own. What we call is
 * in all, so that of the headers is only tried first. */
static bool icu_load(int version)
{
    static const struct {
        const char *name;
        size_t at;
    } called[] = {{"ubrk_open", offsetof(__typeof__(icu), open)},
                  {"ubrk_close", offsetof(__typeof__(icu), close)},
                  {"ubrk_setText", offsetof(__typeof__(icu), text_set)},
                  {"ubrk_next", offsetof(__typeof__(icu), next)},
                  {"ubrk_getRuleStatus", offsetof(__typeof__(icu), status)},
                  {"u_getIntPropertyValue", offsetof(__typeof__(icu), property)}};
    enum { CALLED = sizeof called / sizeof *called };
    struct library_function functions[CALLED];
    char names[CALLED][32], file[32];
    const char *missing;
    for (int i = 0; i < CALLED; i++) {
        snprintf(names[i], sizeof names[i], "%s_%d", called[i].name, version);
        functions[i] = (struct library_function){names[i], called[i].at};
    }
    snprintf(file, sizeof file, "libicuuc.so.%d", version);
    icu_version = version;
    return library_load_exactly(file, functions, CALLED, &icu, &missing);
}

static void icu_begin(void)
{
    int versions[8];
    icu_there = icu_load(U_ICU_VERSION_MAJOR_NUM);
    for (size_t i = 0, n = icu_there ? 0 : library_versions("libicuuc.so.", versions, 8);
         i < n && !icu_there; i++)
        icu_there = icu_load(versions[i]);
}

static void icu_end(void) __attribute__((destructor));
static void icu_end(void)
{
    for (int i = 0; i < iterators_count; i++)
        icu.close(iterators[i].iterator);
    iterators_count = 0;
}

/* The language's iterator, NULL if there is none. Under the lock. */
static UBreakIterator *iterator_of(const char *language)
{
    UErrorCode error = U_ZERO_ERROR;
    char name[sizeof iterators->language];
    snprintf(name, sizeof name, "%s", language ? language : "");
    for (int i = 0; i < iterators_count; i++)
        if (strcmp(iterators[i].language, name) == 0)
            return iterators[i].iterator;
    if (iterators_count == LANGUAGES_MAX)
        return iterators[0].iterator;
    UBreakIterator *made = icu.open(UBRK_LINE, name, NULL, 0, &error);
    if (U_FAILURE(error))
        return NULL;
    memcpy(iterators[iterators_count].language, name, sizeof name);
    iterators[iterators_count++].iterator = made;
    return made;
}

static bool by_icu(const uint32_t *characters, int count, const char *language, char *breaks)
{
    UChar *text = calloc(2 * (size_t)count + 1, sizeof *text);
    int32_t *behind = calloc(2 * (size_t)count + 1, sizeof *behind), units = 0;
    UErrorCode error = U_ZERO_ERROR;
    bool good = text && behind;
    for (int i = 0; good && i < count; i++) {
        uint32_t c = characters[i];
        c = c > 0x10ffff || (c >= 0xd800 && c < 0xe000) ? 0xfffd : c;
        breaks[i] = LINEBREAK_NOBREAK;
        if (c > 0xffff)
            text[units++] = (UChar)(0xd7c0 + (c >> 10));
        text[units++] = c > 0xffff ? (UChar)(0xdc00 | (c & 0x3ff)) : (UChar)c;
        behind[units] = i + 1;
    }
    pthread_mutex_lock(&icu_lock);
    UBreakIterator *iterator = good ? iterator_of(language) : NULL;
    if (iterator)
        icu.text_set(iterator, text, units, &error);
    good = iterator && U_SUCCESS(error);
    for (int32_t at; good && (at = icu.next(iterator)) != UBRK_DONE;)
        if (behind[at])
            breaks[behind[at] - 1] = icu.status(iterator) >= UBRK_LINE_HARD
                                         ? LINEBREAK_MUSTBREAK
                                         : LINEBREAK_ALLOWBREAK;
    pthread_mutex_unlock(&icu_lock);
    free(text);
    free(behind);
    return good;
}

/* ---- the one or the other ---- */

/* Letters, digits and signs of which both say the same. */
static bool plain(uint32_t c)
{
    return c == ' ' || c == ',' || c == '.' || c == 0xad || (c >= 'a' && c <= 'z') ||
           (c >= 'A' && c <= 'Z') || (c >= 0xc0 && c <= 0x17f && c != 0xd7 && c != 0xf7) ||
           c == '(' || c == ')' || c == ';' || c == ':' || c == '!' || c == '?' || c == '\'';
}

/* Do both say the same here? Since Unicode 15.1 a line may end between a quotation mark and an
 * opening bracket, if there is white space. */
static bool plain_at(const uint32_t *characters, int at)
{
    int before = at - 1;
    while (before >= 0 && characters[before] == ' ')
        before--;
    return plain(characters[at]) && !(characters[at] == '(' && before >= 0 && before < at - 1 &&
                                      characters[before] == '\'');
}

bool font_breaks_plain(const uint32_t *characters, int count)
{
    int first = 0; /* white space at the beginning is no plain text */
    while (first < count && plain_at(characters, first) && characters[0] != ' ')
        first++;
    return first == count;
}

bool font_breaks_find(const uint32_t *characters, int count, const char *language, char *breaks)
{
    if (!font_breaks_plain(characters, count)) {
        pthread_once(&icu_once, icu_begin);
        if (icu_there && by_icu(characters, count, language, breaks))
            return true;
    }
    return by_unibreak(characters, count, language, breaks);
}

bool font_breaks_by_icu(const uint32_t *characters, int count, const char *language,
                        char *breaks)
{
    pthread_once(&icu_once, icu_begin);
    return icu_there && by_icu(characters, count, language, breaks);
}

enum font_stand font_stand_of(uint32_t character)
{
    enum { ORIENTATIONS_SINCE = 63 };
    pthread_once(&icu_once, icu_begin);
    if (!icu_there || icu_version < ORIENTATIONS_SINCE)
        return FONT_STAND_UNKNOWN;
    switch (icu.property((UChar32)character, UCHAR_VERTICAL_ORIENTATION)) {
    case U_VO_UPRIGHT:
    case U_VO_TRANSFORMED_UPRIGHT:
        return FONT_STANDS;
    case U_VO_TRANSFORMED_ROTATED:
        return FONT_STANDS_IF_DRAWN;
    default:
        return FONT_LIES;
    }
}

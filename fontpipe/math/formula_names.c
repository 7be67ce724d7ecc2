/* formula_names.c - the names of TeX's symbols, what characters are, and Unicode's mathematical
 * alphabets. */
#include "formula_internal.h"

#include <stdlib.h>
#include <string.h>

/* In the order of strcmp(). Of an operator with limits: USUAL; without: NONE. */
static const struct formula_symbol symbols[] = {
#define ORD(name, character) {name, character, FORMULA_ORD, FORMULA_LIMITS_USUAL},
#define BIN(name, character) {name, character, FORMULA_BIN, FORMULA_LIMITS_USUAL},
#define REL(name, character) {name, character, FORMULA_REL, FORMULA_LIMITS_USUAL},
#define OPEN(name, character) {name, character, FORMULA_OPEN, FORMULA_LIMITS_USUAL},
#define CLOSE(name, character) {name, character, FORMULA_CLOSE, FORMULA_LIMITS_USUAL},
#define PUNCT(name, character) {name, character, FORMULA_PUNCT, FORMULA_LIMITS_USUAL},
#define INNER(name, character) {name, character, FORMULA_INNER, FORMULA_LIMITS_USUAL},
#define SUM(name, character) {name, character, FORMULA_OP, FORMULA_LIMITS_USUAL},
#define INT(name, character) {name, character, FORMULA_OP, FORMULA_LIMITS_NONE},
#include "symbols.tab"
#undef ORD
#undef BIN
#undef REL
#undef OPEN
#undef CLOSE
#undef PUNCT
#undef INNER
#undef SUM
#undef INT
};

enum { SYMBOLS_COUNT = sizeof symbols / sizeof *symbols };

const struct formula_symbol *formula_symbol_find(const char *name, size_t bytes)
{
    int from = 0, to = SYMBOLS_COUNT;
    while (from < to) {
        int middle = from + (to - from) / 2;
        int order = strncmp(symbols[middle].name, name, bytes);
        if (order == 0)
            order = symbols[middle].name[bytes] != '\0';
        if (order == 0)
            return &symbols[middle];
        if (order < 0)
            from = middle + 1;
        else
            to = middle;
    }
    return NULL;
}

enum formula_class formula_class_of(uint32_t c)
{
    static const struct {
        const char *characters;
        enum formula_class class;
    } ascii[] = {{"+-*", FORMULA_BIN},
                 {"=<>:", FORMULA_REL},
                 {"([{", FORMULA_OPEN},
                 {")]}!?", FORMULA_CLOSE},
                 {",;", FORMULA_PUNCT}};
    if (c < 0x80) {
        for (size_t i = 0; i < sizeof ascii / sizeof *ascii; i++)
            if (c && strchr(ascii[i].characters, (int)c))
                return ascii[i].class;
        return FORMULA_ORD;
    }
    for (int i = 0; i < SYMBOLS_COUNT; i++)
        if (symbols[i].character == c)
            return symbols[i].class;
    return FORMULA_ORD;
}

/* ---- alphabets ---- */

/* Where the alphabets' letters begin: A, a, Alpha, alpha, 0; 0: it has none. */
struct alphabet {
    uint32_t upper, lower, greek_upper, greek_lower, digits;
};

static const struct alphabet alphabets[] = {
    [FORMULA_ITALIC] = {0x1d434, 0x1d44e, 0, 0x1d6fc, 0},
    [FORMULA_UPRIGHT] = {0, 0, 0, 0, 0},
    [FORMULA_BOLD] = {0x1d400, 0x1d41a, 0x1d6a8, 0x1d6c2, 0x1d7ce},
    [FORMULA_BOLD_ITALIC] = {0x1d468, 0x1d482, 0x1d71c, 0x1d736, 0x1d7ce},
    [FORMULA_DOUBLE] = {0x1d538, 0x1d552, 0, 0, 0x1d7d8},
    [FORMULA_SCRIPT] = {0x1d49c, 0x1d4b6, 0, 0, 0},
    [FORMULA_FRAKTUR] = {0x1d504, 0x1d51e, 0, 0, 0},
    [FORMULA_SANS] = {0x1d5a0, 0x1d5ba, 0, 0, 0x1d7e2},
    [FORMULA_MONO] = {0x1d670, 0x1d68a, 0, 0, 0x1d7f6}};

/* Letters that Unicode had before, elsewhere. */
static uint32_t letter_elsewhere(uint32_t c)
{
    static const uint32_t moved[][2] = {
        {0x1d455, 0x210e}, {0x1d49d, 0x212c}, {0x1d4a0, 0x2130}, {0x1d4a1, 0x2131},
        {0x1d4a3, 0x210b}, {0x1d4a4, 0x2110}, {0x1d4a7, 0x2112}, {0x1d4a8, 0x2133},
        {0x1d4ad, 0x211b}, {0x1d4ba, 0x212f}, {0x1d4bc, 0x210a}, {0x1d4c4, 0x2134},
        {0x1d506, 0x212d}, {0x1d50b, 0x210c}, {0x1d50c, 0x2111}, {0x1d515, 0x211c},
        {0x1d51d, 0x2128}, {0x1d53a, 0x2102}, {0x1d53f, 0x210d}, {0x1d545, 0x2115},
        {0x1d547, 0x2119}, {0x1d548, 0x211a}, {0x1d549, 0x211d}, {0x1d551, 0x2124}};
    for (size_t i = 0; i < sizeof moved / sizeof *moved; i++)
        if (moved[i][0] == c)
            return moved[i][1];
    return c;
}

/* Greek letters that stand behind omega in the alphabets: epsilon, theta, kappa, phi, rho, pi
 * as variants, and partial. */
static uint32_t greek_variant(uint32_t c, uint32_t alpha)
{
    static const uint32_t variants[] = {0x2202, 0x3f5, 0x3d1, 0x3f0, 0x3d5, 0x3f1, 0x3d6};
    for (uint32_t i = 0; i < sizeof variants / sizeof *variants; i++)
        if (variants[i] == c)
            return alpha + 25 + i;
    return c;
}

uint32_t formula_letter(uint32_t c, enum formula_alphabet name)
{
    const struct alphabet *a = &alphabets[name];
    if (c >= 'A' && c <= 'Z' && a->upper)
        return letter_elsewhere(a->upper + c - 'A');
    if (c >= 'a' && c <= 'z' && a->lower)
        return letter_elsewhere(a->lower + c - 'a');
    if (c >= '0' && c <= '9' && a->digits)
        return a->digits + c - '0';
    if (c >= 0x391 && c <= 0x3a9 && c != 0x3a2 && a->greek_upper)
        return a->greek_upper + c - 0x391;
    if (c >= 0x3b1 && c <= 0x3c9 && a->greek_lower)
        return a->greek_lower + c - 0x3b1;
    if (c == 0x2207 && a->greek_upper)
        return a->greek_upper + 25;
    if (a->greek_lower)
        return greek_variant(c, a->greek_lower);
    return c;
}

uint32_t formula_struck(uint32_t c)
{
    static const uint32_t struck[][2] = {
        {'=', 0x2260},    {'<', 0x226e},    {'>', 0x226f},    {0x2208, 0x2209},
        {0x220b, 0x220c}, {0x2203, 0x2204}, {0x2223, 0x2224}, {'|', 0x2224},
        {0x2225, 0x2226}, {0x223c, 0x2241}, {0x2243, 0x2244}, {0x2245, 0x2247},
        {0x2248, 0x2249}, {0x2261, 0x2262}, {0x2264, 0x2270}, {0x2265, 0x2271},
        {0x227a, 0x2280}, {0x227b, 0x2281}, {0x2282, 0x2284}, {0x2283, 0x2285},
        {0x2286, 0x2288}, {0x2287, 0x2289}, {0x22a2, 0x22ac}, {0x22a8, 0x22ad},
        {0x2190, 0x219a}, {0x2192, 0x219b}, {0x2194, 0x21ae}, {0x21d0, 0x21cd},
        {0x21d2, 0x21cf}, {0x21d4, 0x21ce}};
    for (size_t i = 0; i < sizeof struck / sizeof *struck; i++)
        if (struck[i][0] == c)
            return struck[i][1];
    return 0;
}

/* ---- environments ---- */

const struct formula_table *formula_table_find(const char *name, size_t bytes)
{
    static const struct formula_table tables[] = {
        {"matrix", 0, 0, "c", 1, 0, FORMULA_TEXT, false, 0},
        {"pmatrix", '(', ')', "c", 1, 0, FORMULA_TEXT, false, 0},
        {"bmatrix", '[', ']', "c", 1, 0, FORMULA_TEXT, false, 0},
        {"Bmatrix", '{', '}', "c", 1, 0, FORMULA_TEXT, false, 0},
        {"vmatrix", '|', '|', "c", 1, 0, FORMULA_TEXT, false, 0},
        {"Vmatrix", 0x2016, 0x2016, "c", 1, 0, FORMULA_TEXT, false, 0},
        {"smallmatrix", 0, 0, "c", 0.2778, 0, FORMULA_SCRIPT_STYLE, false, 0},
        {"cases", '{', 0, "l", 1, 0, FORMULA_TEXT, false, 0},
        {"rcases", 0, '}', "l", 1, 0, FORMULA_TEXT, false, 0},
        {"dcases", '{', 0, "l", 1, 0.3, FORMULA_DISPLAY, false, 0},
        {"drcases", 0, '}', "l", 1, 0.3, FORMULA_DISPLAY, false, 0},
        {"array", 0, 0, "c", 1, 0, FORMULA_TEXT, false, 'c'},
        {"subarray", 0, 0, "c", 0, 0, FORMULA_SCRIPT_STYLE, false, 'c'},
        {"alignedat", 0, 0, "rl", 0, 0.3, FORMULA_DISPLAY, true, 'n'},
        {"alignat", 0, 0, "rl", 0, 0.3, FORMULA_DISPLAY, true, 'n'},
        {"alignat*", 0, 0, "rl", 0, 0.3, FORMULA_DISPLAY, true, 'n'},
        {"eqnarray", 0, 0, "rcl", 0.2778, 0.3, FORMULA_DISPLAY, false, 0},
        {"eqnarray*", 0, 0, "rcl", 0.2778, 0.3, FORMULA_DISPLAY, false, 0},
        {"multline", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0},
        {"multline*", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0},
        {"substack", 0, 0, "c", 0, 0, FORMULA_SCRIPT_STYLE, false, 0},
        {"gathered", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0},
        {"gather", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0},
        {"gather*", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0},
        {"aligned", 0, 0, "rl", 1, 0.3, FORMULA_DISPLAY, true, 0},
        {"align", 0, 0, "rl", 1, 0.3, FORMULA_DISPLAY, true, 0},
        {"align*", 0, 0, "rl", 1, 0.3, FORMULA_DISPLAY, true, 0},
        {"split", 0, 0, "rl", 1, 0.3, FORMULA_DISPLAY, true, 0},
        {"equation", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0},
        {"equation*", 0, 0, "c", 0, 0.3, FORMULA_DISPLAY, false, 0}};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        if (strlen(tables[i].name) == bytes && memcmp(tables[i].name, name, bytes) == 0)
            return &tables[i];
    return NULL;
}

/* springs_word.c - springy words in scripts: spring.word{...}, their letters, and masks of
 * them. */
#include "script_mask.h"
#include "script_springs.h"

#include <edges.h>
#include <edits.h>
#include <word_gray.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_BYTES_MAX = 20000, PATH_POINTS_MAX = 10000, CIRCLE_POINTS = 721, KEYS_MAX = 64 };

/* ---- what a word is made of ---- */

/* The text options, and every control of a word and of the world. */
static const char *const *word_keys(void)
{
    static const char *keys[KEYS_MAX] = {"text",   "font",  "size",  "x",
                                         "y",      "width", "align", "features",
                                         "preset", "path",  "circle"};
    enum { FIRST = 11 };
    for (int i = 0; i < dyn_word_controls_count; i++)
        keys[FIRST + i] = dyn_word_controls[i].name;
    for (int i = 0; i < dyn_controls_count; i++)
        keys[FIRST + dyn_word_controls_count + i] = dyn_controls[i].name;
    return keys;
}

static struct font_shaper *shaper_of(lua_State *L, struct script_network *s, const char *name)
{
    for (int i = 0; i < s->fonts_count; i++)
        if (strcmp(s->fonts[i].name, name) == 0)
            return s->fonts[i].shaper;
    struct script_font *font = &s->fonts[s->fonts_count];
    if (s->fonts_count == SCRIPT_FONTS_OF_NETWORK || strlen(name) >= sizeof font->name)
        luaL_error(L, "a network's words have up to %d fonts, of short names",
                   SCRIPT_FONTS_OF_NETWORK);
    const char *path = script_font(L, name, "word font");
    script_network_font_take(L, s);
    if (font_edits_open(path, 0, false, &font->face) != FONT_OK)
        script_fail(L, font_error());
    if (font_shaper_create(font->face, &font->shaper) != FONT_OK) {
        font_face_close(font->face);
        script_fail(L, font_error());
    }
    strcpy(font->name, name);
    s->fonts_count++;
    script_edits_tell(L);
    return font->shaper;
}

static void missing_tell(lua_State *L, const struct dyn_word_def *def, const char *font)
{
    struct font_layout layout = {0};
    if (font_shaper_layout(def->shaper, def->text, strlen(def->text), 16, NULL, &layout) !=
        FONT_OK)
        return; /* dyn_word_create() says why */
    const struct font_layout lacks = layout;
    font_layout_finish(&layout);
    script_missing_tell(L, font, lacks.missing, lacks.missing_count);
}

/* Reads the controls in the options at index into a style and a world. */
static void controls_read(lua_State *L, int index, const struct control *controls, int count,
                          void *of)
{
    for (int i = 0; i < count; i++) {
        lua_pushstring(L, controls[i].name);
        if (lua_rawget(L, index) == LUA_TNIL)
            lua_pop(L, 1);
        else
            script_dyn_check(
                L, dyn_control_write(&controls[i], of, script_control_pop(L, &controls[i])));
    }
}

/* path = {{x, y}, …}: points, in memory that is freed with the userdata pushed. */
static void path_read(lua_State *L, int index, struct dyn_word_def *def)
{
    double circle[4] = {0, 0, 1, 90};
    double(*points)[2];
    bool round = script_arg_numbers(L, index, "word", "circle", circle, 4, -1e5, 1e5);
    lua_pushstring(L, "path");
    int type = lua_rawget(L, index), table = lua_gettop(L);
    size_t count = type == LUA_TTABLE ? lua_rawlen(L, table) : 0;
    void **memory = script_box_new(L);
    if (type == LUA_TNIL && !round)
        return;
    if (type != LUA_TNIL && (round || count < 2 || count > PATH_POINTS_MAX))
        luaL_error(L, "word path must be 2..%d points {x, y}, and there is no circle then",
                   PATH_POINTS_MAX);
    count = round ? CIRCLE_POINTS : count;
    *memory = points = malloc(count * sizeof *points);
    if (!points)
        luaL_error(L, "no memory for a path");
    if (round)
        dyn_path_circle(circle[0], circle[1], circle[2], circle[3], points, CIRCLE_POINTS);
    for (size_t i = 0; !round && i < count; i++) {
        if (lua_rawgeti(L, table, (lua_Integer)i + 1) != LUA_TTABLE)
            luaL_error(L, "word path's points must be {x, y} (got a %s)", luaL_typename(L, -1));
        for (int k = 0; k < 2; k++) {
            lua_rawgeti(L, -1, k + 1);
            points[i][k] = script_arg_at(L, -1, "a path's place", -1e5, 1e5);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    def->path = (const double(*)[2])points;
    def->path_count = (int)count;
}

/* Adds a word with the options at index 2 to a new network, which is pushed, or to the one
 * at index 1. */
static void word_add(lua_State *L, struct script_network *s)
{
    static const char *const aligns[] = {"start", "left", "right", "center", "justify", NULL};
    static const char *const fonts[] = {"DejaVuSans", "EBGaramond12-Regular", NULL};
    struct dyn_word_def def = dyn_word_def_usual();
    struct dyn_world world = *dyn_network_world(s->network);
    if (s->words_count == SCRIPT_WORDS_OF_NETWORK)
        luaL_error(L, "a network has up to %d words", SCRIPT_WORDS_OF_NETWORK);
    script_arg_options(L, 2, "word", word_keys());
    def.text = script_arg_text(L, 2, "word", "text");
    if (!def.text || strlen(def.text) > TEXT_BYTES_MAX)
        luaL_error(L, "word text must be a text of up to %d bytes", TEXT_BYTES_MAX);
    def.size = script_arg_number(L, 2, "word", "size", 1, 0.01, 1000);
    def.x = script_arg_number(L, 2, "word", "x", 0, -1e5, 1e5);
    def.y = script_arg_number(L, 2, "word", "y", 0, -1e5, 1e5);
    def.width = script_arg_number(L, 2, "word", "width", 0, 0, 1e5);
    def.features = script_arg_text(L, 2, "word", "features");
    const char *align = script_arg_text(L, 2, "word", "align");
    const char *preset = script_arg_text(L, 2, "word", "preset");
    const char *named = script_arg_text(L, 2, "word", "font");
    const char *font = named ? named : font_face_first(fonts);
    def.align = align ? (enum font_align)script_arg_choice(L, "word align", align, aligns)
                      : FONT_ALIGN_START;
    def.shaper = shaper_of(L, s, font);
    missing_tell(L, &def, font);
    if (preset) {
        script_dyn_check(L, dyn_preset_apply(preset, &def.style, &world));
        script_dyn_check(L, dyn_preset_fit(preset, &def, NULL));
    }
    controls_read(L, 2, dyn_word_controls, dyn_word_controls_count, &def.style);
    controls_read(L, 2, dyn_controls, dyn_controls_count, &world);
    path_read(L, 2, &def);
    script_dyn_check(L, dyn_word_create(s->network, &def, &s->words[s->words_count]));
    s->words_count++;
    script_dyn_check(L, dyn_network_world_set(s->network, &world));
    script_network_count(L, s);
}

/* spring.word{text =, …}: a network with the word; n:word{…}: adds a word and returns its
 * number */
static int make_word(lua_State *L)
{
    lua_settop(L, 1);
    lua_pushnil(L);
    lua_insert(L, 1); /* the options are second, as for n:word */
    struct script_network *s = script_network_new(L);
    int network = lua_gettop(L);
    word_add(L, s);
    lua_settop(L, network);
    return 1;
}

static int network_word(lua_State *L)
{
    lua_settop(L, 2);
    struct script_network *s = script_network_at(L, 1);
    word_add(L, s);
    lua_pushinteger(L, s->words_count);
    return 1;
}

/* n:hang(upper, lower): hangs the word `lower` on the word `upper` */
static int network_hang(lua_State *L)
{
    struct script_network *s = script_network_at(L, 1);
    long words[2];
    int first, count;
    for (int i = 0; i < 2; i++)
        words[i] = script_arg_index(L, 2 + i, "a word's number", s->words_count);
    if (words[0] == words[1])
        luaL_error(L, "a word cannot hang from itself");
    script_dyn_check(
        L, dyn_words_hang(s->network, s->words[words[0]], s->words[words[1]], &first, &count));
    script_network_count(L, s);
    return 0;
}

/* ---- letters ---- */

/* Letters of all words are numbered through. */
static const struct dyn_word *letter_find(lua_State *L, const struct script_network *s,
                                          int *letter)
{
    int all = 0;
    for (int i = 0; i < s->words_count; i++)
        all += dyn_word_letters_count(s->words[i]);
    int number = script_arg_index(L, 2, "a letter's number", all);
    for (int i = 0; i < s->words_count; i++) {
        int count = dyn_word_letters_count(s->words[i]);
        if (number < count) {
            *letter = number;
            return s->words[i];
        }
        number -= count;
    }
    return NULL;
}

static int network_letters(lua_State *L)
{
    const struct script_network *s = script_network_at(L, 1);
    lua_Integer all = 0;
    for (int i = 0; i < s->words_count; i++)
        all += dyn_word_letters_count(s->words[i]);
    lua_pushinteger(L, all);
    return 1;
}

/* n:letter(number): the numbers of its masses: lower left, lower right, upper right, upper
 * left */
static int network_letter(lua_State *L)
{
    int letter = 0;
    const struct dyn_word *word = letter_find(L, script_network_at(L, 1), &letter);
    if (!word)
        return luaL_error(L, "there are no letters");
    for (int k = 0; k < 4; k++)
        lua_pushinteger(L, dyn_word_letter(word, letter)->mass[k] + 1);
    return 4;
}

/* ---- masks ---- */

/* Gets the letter's gray and its place in the picture. False: the letter is not visible. */
static bool letter_draw(lua_State *L, struct script_network *s, const struct dyn_word *word,
                        int index, const struct dyn_view *view, const struct font_gray **gray)
{
    struct font_point to[4];
    dyn_word_corners(word, s->network, index, view, to);
    for (int i = 0; i < 4; i++)
        if (!(fabs(to[i].x) < SCRIPT_PLACE_MAX && fabs(to[i].y) < SCRIPT_PLACE_MAX))
            return false;
    /* the most memory for drawing, descenders included: checked, and released at once */
    double wide = fmax(fmax(to[0].x, to[1].x), fmax(to[2].x, to[3].x)) -
                  fmin(fmin(to[0].x, to[1].x), fmin(to[2].x, to[3].x)) + 16;
    double high = fmax(fmax(to[0].y, to[1].y), fmax(to[2].y, to[3].y)) -
                  fmin(fmin(to[0].y, to[1].y), fmin(to[2].y, to[3].y)) + 16;
    script_memory_take(L, 16 * wide * high, "a letter");
    script_memory_give(s->script, 16 * wide * high);
    enum font_status status = dyn_word_gray(word, index, view, to, s->painter, gray);
    if (status == FONT_NO_MEMORY)
        script_fail(L, font_error());
    return status == FONT_OK && (*gray)->width_px > 0;
}

/* For each visible letter: extends the box, or draws onto the mask. */
static void letters_go(lua_State *L, struct script_network *s, const struct dyn_view *view,
                       struct font_box *box, struct script_mask *mask)
{
    for (int i = 0; i < s->words_count; i++)
        for (int k = 0; k < dyn_word_glyphs_count(s->words[i]); k++) {
            const struct font_gray *gray;
            script_check(L);
            if (!letter_draw(L, s, s->words[i], k, view, &gray))
                continue;
            box->x0 = fmin(box->x0, gray->left_px);
            box->y0 = fmin(box->y0, gray->top_px);
            box->x1 = fmax(box->x1, gray->left_px + gray->width_px);
            box->y1 = fmax(box->y1, gray->top_px + gray->height_px);
            if (mask) /* a finalizer may have moved letters since it was measured */
                dyn_gray_over(gray, mask->gray, mask->x, mask->y, mask->width, mask->height);
        }
}

/* n:mask{scale =, x =, y =}: a mask of all letters as they are; the world's origin is at (x,
 * y), with y upwards in the world */
static int network_mask(lua_State *L)
{
    static const char *const keys[] = {"scale", "x", "y", NULL};
    lua_settop(L, 2);
    struct script_network *s = script_network_at(L, 1);
    script_arg_options(L, 2, "mask", keys);
    struct dyn_view view = {
        script_arg_number(L, 2, "mask", "scale", 100, 0.1, 10000),
        script_arg_number(L, 2, "mask", "x", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX),
        script_arg_number(L, 2, "mask", "y", 0, -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX)};
    struct font_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY}, again = box;
    struct font_painter_def def = font_painter_def_default();
    if (!s->painter)
        script_network_painter_take(L, s);
    if (!s->painter && font_painter_create(&def, &s->painter) != FONT_OK)
        script_fail(L, font_error());
    letters_go(L, s, &view, &box, NULL);
    if (!(box.x1 > box.x0)) {
        script_mask_new(L); /* no letter is visible */
        return 1;
    }
    struct script_mask *mask =
        script_mask_gray_new(L, box.x1 - box.x0, box.y1 - box.y0, box.x0, box.y0);
    letters_go(L, s, &view, &again, mask);
    return 1;
}

const luaL_Reg script_spring_word_makers[] = {{"word", make_word}, {NULL, NULL}};

const luaL_Reg script_network_word_methods[] = {
    {"word", network_word},     {"hang", network_hang}, {"letters", network_letters},
    {"letter", network_letter}, {"mask", network_mask}, {NULL, NULL}};

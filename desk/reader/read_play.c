/* read_play.c - recorded input in place of a hand: lines "SECONDS WORD VALUES", each done when
 * its time has come (docs/reader.md). */
#include "read_desk.h"

#include <input_file.h>
#include <math.h>
#include <string.h>
#include <visible_text.h>

struct input {
    double time_s, value[3];
    const struct word *word;
    char *text; /* of words that have one */
};

struct read_play {
    struct read_desk *desk;
    GArray *inputs; /* struct input */
    guint next;
    gint64 last_us;
    double time_s;
    GdkPaintable *seen; /* the window, as it was drawn last */
};

struct word {
    const char *name;
    int values; /* numbers; -1: the rest of the line */
    void (*does)(struct read_desk *d, const struct input *input);
};

/* ---- what words do ---- */

static void down(struct read_desk *d, const struct input *i)
{
    read_hand_press(d, i->value[0], i->value[1], (int)i->value[2]);
}

static void move(struct read_desk *d, const struct input *i)
{
    read_hand_move(d, i->value[0], i->value[1]);
}

static void up(struct read_desk *d, const struct input *i)
{
    read_hand_release(d, i->value[0], i->value[1]);
}

static void press(struct read_desk *d, const struct input *i)
{
    read_ink_press(d, i->value[0], i->value[1], i->value[2], i->time_s, false);
}

/* With Shift. */
static void press_more(struct read_desk *d, const struct input *i)
{
    read_ink_press(d, i->value[0], i->value[1], i->value[2], i->time_s, true);
}

static void drag(struct read_desk *d, const struct input *i)
{
    read_ink_move(d, i->value[0], i->value[1], i->value[2], i->time_s);
}

static void lift(struct read_desk *d, const struct input *i)
{
    read_ink_release(d, i->value[0], i->value[1]);
}

static void note(struct read_desk *d, const struct input *i)
{
    read_remarks_typed(d, i->text);
}

/* The first place of these words. */
static void choose(struct read_desk *d, const struct input *i)
{
    if (!reader_document_search(d->document, i->text, 0, true, &d->selected.begin,
                                &d->selected.end))
        d->say(d, i->text);
    read_edit_select(d, d->selected);
    read_page_changed(d);
}

static void scroll(struct read_desk *d, const struct input *i)
{
    read_hand_scroll(d, i->value[0]);
}

static void glide(struct read_desk *d, const struct input *i)
{
    read_hand_glide(d, i->value[0]);
}

static void nothing_does(struct read_desk *d, const char *name)
{
    char *told = g_strdup_printf("nothing is done by the key %s", name);
    d->say(d, told);
    g_free(told);
}

static void key(struct read_desk *d, const struct input *i)
{
    if (!read_keys_key(d, gdk_keyval_from_name(i->text), 0))
        nothing_does(d, i->text);
}

/* Letters as an input method gives them. */
static void type(struct read_desk *d, const struct input *i)
{
    read_edit_type(d, i->text);
}

static void preedit(struct read_desk *d, const struct input *i)
{
    read_edit_preedit(d, i->text);
}

/* A key with what is held: "Control+Shift+Left". */
static void strike(struct read_desk *d, const struct input *i)
{
    const char *plus = strrchr(i->text, '+');
    GdkModifierType state = 0;
    state |= strstr(i->text, "Shift+") ? GDK_SHIFT_MASK : 0;
    state |= strstr(i->text, "Control+") ? GDK_CONTROL_MASK : 0;
    const guint value = gdk_keyval_from_name(plus ? plus + 1 : i->text);
    if (!read_edit_key(d, value, state) && !read_keys_key(d, value, state))
        nothing_does(d, i->text);
}

static void replace(struct read_desk *d, const struct input *i)
{
    read_edit_replace(d, i->text, true);
}

/* To the question whether what was edited is saved: save, discard, stay. */
static void answer(struct read_desk *d, const struct input *i)
{
    const int response = g_str_equal(i->text, "save")      ? GTK_RESPONSE_YES
                         : g_str_equal(i->text, "discard") ? GTK_RESPONSE_NO
                                                           : GTK_RESPONSE_CANCEL;
    if (!read_save_answer(d, response))
        d->say(d, "nothing was asked");
}

static void size(struct read_desk *d, const struct input *i)
{
    read_look_size(d, i->value[0]);
}

static void column(struct read_desk *d, const struct input *i)
{
    read_look_column(d, i->value[0]);
}

static void window(struct read_desk *d, const struct input *i)
{
    gtk_window_set_default_size(GTK_WINDOW(d->window), (int)i->value[0], (int)i->value[1]);
}

static void dark(struct read_desk *d, const struct input *i)
{
    read_look_theme(d, i->value[0] != 0);
}

static void search(struct read_desk *d, const struct input *i)
{
    read_search_open(d, true);
    gtk_editable_set_text(GTK_EDITABLE(d->search_entry), i->text);
    read_search_text(d, i->text);
}

static void follow(struct read_desk *d, const struct input *i)
{
    size_t begin, end;
    if (!reader_document_search(d->document, i->text, 0, true, &begin, &end) ||
        !read_document_follow(d, begin))
        d->say(d, i->text);
}

static void go(struct read_desk *d, const struct input *i)
{
    size_t begin, end;
    if (reader_document_search(d->document, i->text, 0, true, &begin, &end))
        read_document_go(d, begin);
    else
        d->say(d, i->text);
}

static void action(struct read_desk *d, const struct input *i)
{
    GAction *found = g_action_map_lookup_action(G_ACTION_MAP(d->window), i->text);
    if (found)
        g_action_activate(found, NULL);
    else
        d->say(d, i->text);
}

/* The window's pixels, as they were drawn last, as a PNG. */
static void picture(struct read_desk *d, const struct input *i)
{
    GtkWidget *widget = GTK_WIDGET(d->window);
    GdkPaintable *now = gdk_paintable_get_current_image(d->play->seen);
    GtkSnapshot *snapshot = gtk_snapshot_new();
    gdk_paintable_snapshot(now, snapshot, gdk_paintable_get_intrinsic_width(now),
                           gdk_paintable_get_intrinsic_height(now));
    GskRenderNode *node = gtk_snapshot_free_to_node(snapshot);
    GskRenderer *renderer = gtk_native_get_renderer(GTK_NATIVE(widget));
    GdkTexture *texture = node ? gsk_renderer_render_texture(renderer, node, NULL) : NULL;
    if (!texture || !gdk_texture_save_to_png(texture, i->text))
        d->say(d, i->text);
    g_clear_object(&texture);
    g_clear_pointer(&node, gsk_render_node_unref);
    g_object_unref(now);
}

/* Where strokes begin, from left to right in the window, in the order in which they are
 * played. */
static char *played_told(struct read_desk *d)
{
    const int room = d->remarks ? reader_remarks_count(d->remarks) : 0;
    struct reader_played *played = g_new(struct reader_played, (gsize)room + 1);
    GString *told = g_string_new(NULL);
    int count = 0;
    if (room)
        reader_remarks_play(d->remarks, false, played, &count);
    for (int i = 0; i < count; i++) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, played[i].index);
        double x, y;
        if (read_text_origin(d, r, &x, &y))
            g_string_append_printf(told, " %.0f", x + d->size_px * reader_ink_place(r, 0).x);
    }
    g_free(played);
    return g_string_free(told, FALSE);
}

/* The box of the strokes that are chosen, and how many are. */
static char *chosen_told(struct read_desk *d)
{
    struct reader_box box;
    if (!read_chosen_box(d, &box))
        return g_strdup_printf("%d", read_chosen_count(d));
    return g_strdup_printf("%d %.1f %.1f %.1f %.1f", read_chosen_count(d), box.x, box.y,
                           box.width, box.height);
}

/* How many parts of lines stand under what is chosen. */
static int under_chosen(struct read_desk *d)
{
    enum { MOST = 1000 };
    const struct reader_shown *shown;
    struct reader_box chosen, *boxes = g_new(struct reader_box, MOST);
    int count = 0, under = 0;
    if (read_chosen_box(d, &chosen))
        reader_view_look(d->view, &shown, &count);
    for (int i = 0; i < count; i++) {
        const int found = reader_view_boxes(d->view, shown[i].begin, shown[i].end, boxes, MOST);
        for (int k = 0; k < MIN(found, MOST); k++)
            under += boxes[k].x < chosen.x + chosen.width &&
                     boxes[k].x + boxes[k].width > chosen.x &&
                     boxes[k].y < chosen.y + chosen.height &&
                     boxes[k].y + boxes[k].height > chosen.y;
    }
    g_free(boxes);
    return under;
}

/* What is seen, as lines of text. */
static void tell(struct read_desk *d, const struct input *i)
{
    const struct reader_shown *shown;
    const struct reader_grid *grid = &d->setup.grid;
    const struct reader_grid_column *last = &grid->columns[MAX(1, grid->columns_count) - 1];
    int count = 0, opened = 0, remarks = 0, orphans = 0;
    double ink_x = -1, ink_y = -1;
    size_t top = 0;
    double above = 0, all = 0;
    reader_view_look(d->view, &shown, &count);
    reader_view_top(d->view, &top);
    reader_view_extent(d->view, &above, &all);
    const struct reader_block *block = reader_document_block(d->document, top);
    for (int k = 0; k < d->document->notes_count; k++)
        opened += reader_view_note_open(d->view, k);
    for (int k = 0; d->remarks && k < reader_remarks_count(d->remarks); k++) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, k);
        remarks += reader_remark_seen(r);
        orphans += reader_remark_seen(r) && r->orphan;
        if (r->kind == READER_REMARK_INK && reader_remark_seen(r) && !r->orphan &&
            read_text_origin(d, r, &ink_x, &ink_y)) {
            ink_x += d->size_px * reader_ink_place(r, 0).x;
            ink_y += d->size_px * reader_ink_place(r, 0).y;
        }
    }
    char *line = g_strndup(d->document->plain + top, 40),
         *selected = read_text_of(d, d->selected), *stages = read_stages_told(d),
         *order = played_told(d), *chosen = chosen_told(d), *editing = read_edit_told(d),
         *small = read_miniatures_told(d);
    char *told = g_strdup_printf(
        "top %zu\nline %s\nshown %d\nabove %.0f\nall %.0f\nset %ld\npainted %ld\nhits %u\nhit "
        "%d\n"
        "open %d\nselected %s\nway %u of %u\nfile %s\nheard %u\nremarks %d\norphans %d\nink "
        "%.1f %.1f\ngrid %d %d\nedge %.1f\nplayed%s\nchosen %s\nunder %d\nrenderer "
        "%s\n%s%s%s",
        top, g_strdelimit(line, "\n", ' '), count, above, all, reader_view_set_count(d->view),
        read_tiles_painted(d->tiles), d->hits->len, d->hit, opened, selected, d->way_at,
        d->way->len, d->files.count ? d->files.paths[block ? block->source : 0] : "",
        d->heard->len, remarks, orphans, ink_x, ink_y, grid->texts, grid->columns_count,
        last->x + last->width, order, chosen, under_chosen(d),
        G_OBJECT_TYPE_NAME(gtk_native_get_renderer(GTK_NATIVE(d->window))), editing, small,
        stages);
    if (!g_file_set_contents(i->text, told, -1, NULL))
        d->say(d, i->text);
    g_free(told);
    g_free(order);
    g_free(chosen);
    g_free(editing);
    g_free(small);
    g_free(stages);
    g_free(selected);
    g_free(line);
}

static void stage(struct read_desk *d, const struct input *i)
{
    if (!read_stages_button(d, (int)i->value[0]))
        d->say(d, "there is no such stage");
}

static void set(struct read_desk *d, const struct input *i)
{
    if (!read_stages_set(d, (int)i->value[0], (int)i->value[1], i->value[2]))
        d->say(d, "there is no such control");
}

/* It was waited for: see play_on(). */
static void await(struct read_desk *d, const struct input *i)
{
    (void)d;
    (void)i;
}

static void template(struct read_desk *d, const struct input *i)
{
    read_grid_open(d, i->text);
}

static void panel(struct read_desk *d, const struct input *i)
{
    if (!read_panel_set(d, i->text))
        d->say(d, "there is no such colour or size");
}

static void layer(struct read_desk *d, const struct input *i)
{
    read_layers_write(d, i->text);
}

static void hide(struct read_desk *d, const struct input *i)
{
    for (int k = 0; d->remarks && k < reader_remarks_layers(d->remarks); k++)
        if (strcmp(reader_remarks_layer(d->remarks, k), i->text) == 0)
            read_layers_show(d, k, !reader_remarks_layer_shown(d->remarks, k));
}

static void template_save(struct read_desk *d, const struct input *i)
{
    read_grid_save(d, i->text);
}

static void end(struct read_desk *d, const struct input *i)
{
    (void)i;
    gtk_window_close(GTK_WINDOW(d->window));
}

static const struct word words[] = {{"down", 3, down},
                                    {"move", 2, move},
                                    {"up", 2, up},
                                    {"scroll", 1, scroll},
                                    {"glide", 1, glide},
                                    {"key", -1, key},
                                    {"size", 1, size},
                                    {"column", 1, column},
                                    {"window", 2, window},
                                    {"dark", 1, dark},
                                    {"search", -1, search},
                                    {"follow", -1, follow},
                                    {"go", -1, go},
                                    {"action", -1, action},
                                    {"picture", -1, picture},
                                    {"tell", -1, tell},
                                    {"press", 3, press},
                                    {"press-more", 3, press_more},
                                    {"drag", 3, drag},
                                    {"lift", 2, lift},
                                    {"note", -1, note},
                                    {"select", -1, choose},
                                    {"stage", 1, stage},
                                    {"await", 2, await},
                                    {"set", 3, set},
                                    {"type", -1, type},
                                    {"preedit", -1, preedit},
                                    {"strike", -1, strike},
                                    {"replace", -1, replace},
                                    {"answer", -1, answer},
                                    {"template", -1, template},
                                    {"save-template", -1, template_save},
                                    {"panel", -1, panel},
                                    {"layer", -1, layer},
                                    {"hide", -1, hide},
                                    {"close", 0, end}};

/* ---- reading ---- */

/* Of words that name a key: that there is one, and what is held with it. Owns: the caller frees
 * what is wrong; NULL: nothing. */
static char *key_wrong(const struct input *input)
{
    static const char known[] =
        "a letter, Left, Right, Up, Down, Home, End, Page_Up, Page_Down, Return, Tab, "
        "ISO_Left_Tab, space, Escape, BackSpace, Delete, plus, minus, slash";
    const bool strikes = input->word->does == strike;
    const char *at = input->text;
    if (!strikes && input->word->does != key)
        return NULL;
    for (const char *plus; strikes && (plus = strchr(at, '+')) && plus[1]; at = plus + 1) {
        const size_t bytes = (size_t)(plus - at);
        if (strncmp(at, "Shift+", 6) != 0 && strncmp(at, "Control+", 8) != 0)
            return g_strdup_printf("'%.*s' is not held with a key; Shift and Control are",
                                   (int)MIN(bytes, 40), at);
    }
    return gdk_keyval_from_name(at) == GDK_KEY_VoidSymbol
               ? g_strdup_printf("no key is called '%.40s'; there are %s", at, known)
               : NULL;
}

/* False: *why has the reason. A line that is empty, or begins with #, has no word. */
static bool line_read(char *line, struct input *input, char **why)
{
    char *at = g_strstrip(line);
    *input = (struct input){0};
    if (!*at || *at == '#')
        return true;
    input->time_s = g_ascii_strtod(at, &at);
    at = g_strchug(at);
    const size_t length = strcspn(at, " ");
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++)
        if (strlen(words[i].name) == length && strncmp(words[i].name, at, length) == 0)
            input->word = &words[i];
    if (!input->word) {
        GString *known = g_string_new(NULL);
        for (size_t i = 0; i < G_N_ELEMENTS(words); i++)
            g_string_append_printf(known, "%s%s", i ? ", " : "", words[i].name);
        *why = g_strdup_printf("no such word: '%.40s'; there are %s", at, known->str);
        g_string_free(known, TRUE);
        return false;
    }
    at = g_strchug(at + length);
    if (input->word->values < 0) {
        input->text = g_strdup(at);
        *why = key_wrong(input);
        return !*why;
    }
    for (int i = 0; i < input->word->values; i++) {
        char *next;
        input->value[i] = g_ascii_strtod(at, &next);
        if (next == at) {
            *why =
                g_strdup_printf("'%s' has %d numbers", input->word->name, input->word->values);
            return false;
        }
        at = next;
    }
    return true;
}

static void input_clear(gpointer item)
{
    g_free(((struct input *)item)->text);
}

struct read_play *read_play_open(struct read_desk *d, const char *path)
{
    const char *reason = "";
    char line[4096], *why = NULL;
    bool good = true;
    FILE *file = input_file_open(path, &reason);
    if (!file) {
        visible_say("lutetia read: %s: cannot read: %s", path, reason);
        return NULL;
    }
    struct read_play *play = g_new0(struct read_play, 1);
    play->desk = d;
    play->inputs = g_array_new(FALSE, FALSE, sizeof(struct input));
    g_array_set_clear_func(play->inputs, input_clear);
    for (int number = 1; good && fgets(line, sizeof line, file); number++) {
        struct input input;
        good = line_read(line, &input, &why);
        if (!good) {
            visible_say("lutetia read: %s:%d: %s", path, number, why);
            g_free(input.text);
        } else if (input.word)
            g_array_append_val(play->inputs, input);
    }
    g_free(why);
    fclose(file);
    if (good)
        return play;
    read_play_destroy(play);
    return NULL;
}

void read_play_destroy(struct read_play *play)
{
    if (!play)
        return;
    g_array_free(play->inputs, TRUE);
    g_clear_object(&play->seen);
    g_free(play);
}

/* One input a frame, so that each is seen before the next one; a slow machine takes longer for
 * the same. */
static gboolean play_on(GtkWidget *widget, GdkFrameClock *clock, gpointer data)
{
    struct read_play *play = data;
    struct read_desk *d = play->desk;
    const gint64 now_us = gdk_frame_clock_get_frame_time(clock);
    const double frame_s = 1.0 / 30;
    (void)widget;
    if (play->last_us)
        play->time_s += fmin(frame_s, (double)(now_us - play->last_us) * 1e-6);
    play->last_us = now_us;
    if (!d->page || !d->view || play->next == play->inputs->len)
        return G_SOURCE_REMOVE;
    const struct input *input = &g_array_index(play->inputs, struct input, play->next);
    const bool waits = input->word->does == await &&
                       read_stages_waits(d, (int)input->value[0], (long)input->value[1]);
    if (input->time_s <= play->time_s && !waits) {
        play->next++;
        input->word->does(d, input);
    }
    if (d->page)
        gtk_widget_queue_draw(d->page);
    return d->page ? G_SOURCE_CONTINUE : G_SOURCE_REMOVE;
}

void read_play_begin(struct read_play *play)
{
    play->seen = gtk_widget_paintable_new(play->desk->window);
    gtk_widget_add_tick_callback(play->desk->page, play_on, play, NULL);
}

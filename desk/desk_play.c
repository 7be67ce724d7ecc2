/* desk_play.c - recorded input (studio_input.h) in place of a hand: below GTK, as what its
 * events have been made into, each when its time has come. */
#include "desk.h"

#include "studio_input.h"

#include <input_file.h>
#include <visible_text.h>

struct desk_play {
    struct desk *desk;
    GArray *inputs; /* struct studio_input */
    guint next;
    double began_s;
    bool begun;
};

struct desk_play *desk_play_open(struct desk *d, const char *path)
{
    const char *reason;
    char line[2 * STUDIO_INPUT_TEXT], why[1000];
    FILE *file = input_file_open(path, &reason);
    if (!file) {
        visible_say("lutetia studio: %s: cannot read: %s", path, reason);
        return NULL;
    }
    struct desk_play *play = g_new0(struct desk_play, 1);
    play->desk = d;
    play->inputs = g_array_new(FALSE, FALSE, sizeof(struct studio_input));
    double before_s = 0;
    int good = 1;
    for (int number = 1; good >= 0 && fgets(line, sizeof line, file); number++) {
        struct studio_input input;
        line[strcspn(line, "\r\n")] = '\0';
        good = studio_input_parse(line, &input, why, sizeof why);
        if (good > 0 && input.time_s < before_s) {
            good = -1;
            snprintf(why, sizeof why, "times do not go back");
        }
        if (good < 0)
            visible_say("lutetia studio: %s:%d: %s", path, number, why);
        else if (good > 0) {
            before_s = input.time_s;
            g_array_append_val(play->inputs, input);
        }
    }
    fclose(file);
    if (good >= 0)
        return play;
    desk_play_destroy(play);
    return NULL;
}

void desk_play_destroy(struct desk_play *play)
{
    if (!play)
        return;
    g_array_free(play->inputs, TRUE);
    g_free(play);
}

static void path_send(struct desk *d, enum studio_message_kind kind, const char *path)
{
    studio_paper_send(
        d->paper, (struct studio_message){.kind = kind, .text = g_strdup(path), .value = 1});
}

static void type_do(struct desk *d, const struct studio_input *input)
{
    desk_set(d, STUDIO_TOOL, STUDIO_TOOL_TYPE);
    desk_type_begin(d, input->x, input->y);
    desk_type_text(d, input->text);
    if (d->settings.value[STUDIO_TYPE_SPRINGS] == 0) /* springy type waits to be thrown */
        desk_type_print(d);
}

static void action_do(struct desk *d, const struct studio_input *input)
{
    if (strcmp(input->name, "close") == 0) {
        desk_hand_event(d, &(struct input_event){.kind = INPUT_CLOSE});
        d->asked = true; /* nobody is there to answer */
    }
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(d->window), input->name);
    if (!action) {
        visible_say("lutetia studio: no action '%s'", input->name);
        d->status = 1;
        return;
    }
    g_simple_action_set_enabled(G_SIMPLE_ACTION(action),
                                TRUE); /* the paper knows what can be undone */
    g_action_activate(action, input->text[0] ? g_variant_new_string(input->text) : NULL);
}

static void input_do(struct desk *d, const struct studio_input *input)
{
    struct input_event event = input->event;
    switch (input->kind) {
    case STUDIO_INPUT_EVENT:
        event.x_px += d->view.width / 2;
        event.y_px += d->view.height / 2;
        desk_hand_event(d, &event);
        break;
    case STUDIO_INPUT_SET:
        desk_set(d, input->setting, input->value);
        break;
    case STUDIO_INPUT_ACTION:
        action_do(d, input);
        break;
    case STUDIO_INPUT_STEP:
        studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_STEP,
                                                            .value = input->value});
        break;
    case STUDIO_INPUT_VIEW:
        d->view.zoom = CLAMP(input->zoom, STUDIO_ZOOM_MIN, STUDIO_ZOOM_MAX);
        d->view.x0 = input->x;
        d->view.y0 = input->y;
        d->view.turn = input->degrees * G_PI / 180;
        d->view.mirrored = input->mirrored;
        desk_canvas_changed(d);
        break;
    case STUDIO_INPUT_TYPE:
        type_do(d, input);
        break;
    case STUDIO_INPUT_SAVE:
        path_send(d, STUDIO_MESSAGE_SAVE, input->text);
        break;
    case STUDIO_INPUT_PICTURE:
        path_send(d, STUDIO_MESSAGE_PICTURE, input->text);
        break;
    case STUDIO_INPUT_MOMENT:
        studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_VISIT,
                                                            .value = input->value});
        break;
    case STUDIO_INPUT_MEASURE:
        desk_measure_begin(d, input->name);
        break;
    case STUDIO_INPUT_PALETTE:
        desk_palette_open(d, input->text);
        break;
    case STUDIO_INPUT_PALETTE_SAVE:
        desk_palette_save(d, input->text);
        break;
    case STUDIO_INPUT_FILM:
        studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_FILM,
                                                            .text = g_strdup(input->text),
                                                            .value = DESK_FILM_S});
        break;
    case STUDIO_INPUT_STAMP:
        desk_stamp_choose(d, input->text);
        break;
    case STUDIO_INPUT_BOOKMARK:
        path_send(d, STUDIO_MESSAGE_BOOKMARK, input->text);
        break;
    case STUDIO_INPUT_SCRIPT:
        path_send(d, STUDIO_MESSAGE_SCRIPT, input->text);
        break;
    }
}

/* What waits until the paper has done all that it was told. */
static bool must_wait(const struct desk *d, const struct studio_input *input)
{
    return desk_beside_due(d) ||
           (input->kind == STUDIO_INPUT_ACTION && strcmp(input->name, "close") == 0 &&
            (!d->report.ready || d->view.width <= 0));
}

static gboolean play_on(gpointer data)
{
    struct desk_play *play = data;
    struct desk *d = play->desk;
    if (d->view.width <= 0 || !d->viewed) /* the canvas has no size yet, or shows nothing */
        return G_SOURCE_CONTINUE;
    if (play->began_s == 0)
        play->began_s = input_now_s();
    while (play->next < play->inputs->len) {
        const struct studio_input *input =
            &g_array_index(play->inputs, struct studio_input, play->next);
        if (input->time_s > input_now_s() - play->began_s || must_wait(d, input))
            return G_SOURCE_CONTINUE;
        play->next++;
        const bool closes =
            input->kind == STUDIO_INPUT_ACTION && strcmp(input->name, "close") == 0;
        input_do(d, input);
        if (closes)
            return G_SOURCE_REMOVE; /* there is no window any more */
    }
    return G_SOURCE_REMOVE;
}

void desk_play_begin(struct desk_play *play)
{
    if (!play->begun)
        g_timeout_add(4, play_on, play);
    play->begun = true;
}

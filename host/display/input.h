/* input.h - user input as events in a queue: pointers and pens, wheels, keys, text, files
 * dropped.
 *
 *     struct input_queue queue = {0};
 *     struct input_event event;
 *     ...a window's callbacks call input_queue_put(&queue, &event)...
 *     while (input_queue_take(&queue, &event))
 *         if (event.kind == INPUT_POINTER_DOWN && event.button == INPUT_BUTTON_LEFT)
 *             grab(event.x_px, event.y_px, event.pressure);
 *     input_queue_finish(&queue);
 *
 * Every source (a GLFW window, a test, a recording) gives the same kind of events. Each event
 * carries its time and the state of the pointer and of the modifiers at that time, so that the
 * receiver need not keep state.
 *
 * Units. Places are pixels of the window, y downwards, fractions possible. Times are seconds
 * of input_now_s(). Pressure is 0..1; tilt is -1..1, the lean of a pen to the right and
 * towards the person, 1 being all that the pen measures. Threads. A queue belongs to one
 * thread at a time.
 */
#ifndef LUTETIA_INPUT_H
#define LUTETIA_INPUT_H

#include <stdbool.h>
#include <stdint.h>

enum input_kind {
    INPUT_NONE,
    INPUT_POINTER_MOVE,
    INPUT_POINTER_DOWN,
    INPUT_POINTER_UP,
    INPUT_POINTER_LEAVE, /* the pointer left the window */
    INPUT_SCROLL,
    INPUT_TEXT, /* text was entered: a character, after the keyboard layout */
    INPUT_KEY_DOWN,
    INPUT_KEY_REPEAT, /* the key is held */
    INPUT_KEY_UP,
    INPUT_DROP,       /* a file was dropped on the window; of several, one event each */
    INPUT_FOCUS_LOST, /* the window lost the focus: no event will come for releases of held
                       * keys and buttons */
    INPUT_SIZE,       /* the window has another size */
    INPUT_CLOSE       /* the user asks to close the window */
};

/* As bits in `buttons`: 1u << button. */
enum { INPUT_BUTTON_LEFT, INPUT_BUTTON_RIGHT, INPUT_BUTTON_MIDDLE, INPUT_BUTTONS = 8 };

enum { INPUT_SHIFT = 1, INPUT_CONTROL = 2, INPUT_ALT = 4, INPUT_SUPER = 8 };

/* Keys that write a character are that character, capital letters for letters: 'A', '1', '
 * '. */
enum {
    INPUT_KEY_ESCAPE = 0x110000, /* above Unicode */
    INPUT_KEY_ENTER,
    INPUT_KEY_TAB,
    INPUT_KEY_BACKSPACE,
    INPUT_KEY_DELETE,
    INPUT_KEY_LEFT,
    INPUT_KEY_RIGHT,
    INPUT_KEY_UP_ARROW,
    INPUT_KEY_DOWN_ARROW,
    INPUT_KEY_HOME,
    INPUT_KEY_END,
    INPUT_KEY_PAGE_UP,
    INPUT_KEY_PAGE_DOWN,
    INPUT_KEY_SHIFT,
    INPUT_KEY_CONTROL,
    INPUT_KEY_F1, /* and so on to F12 */
    INPUT_KEY_F12 = INPUT_KEY_F1 + 11,
    INPUT_KEY_OTHER
};

struct input_event {
    enum input_kind kind;
    double time_s;
    /* The pointer, in every event. */
    double x_px, y_px;
    double pressure, tilt_x, tilt_y; /* of a pen; 0 if the pointer is no pen */
    bool pen;                        /* the pointer is a pen that reports its pressure */
    bool eraser;                     /* the pen is held the other way round */
    unsigned buttons;                /* buttons that are held after the event */
    unsigned modifiers;              /* modifiers (INPUT_SHIFT, ...) that are held */
    /* Of some kinds. */
    int button; /* POINTER_DOWN, POINTER_UP */
    double scroll_x,
        scroll_y;       /* SCROLL: a wheel's steps, to the right and away from the person */
    int key;            /* KEY_: an INPUT_KEY_ or a character */
    uint32_t character; /* TEXT: Unicode */
    int width_px, height_px; /* SIZE */
    char *path;              /* DROP: owned by the queue, until the next event is taken */
};

enum { INPUT_EVENTS_MAX = 1024 };

/* All zeros is an empty queue. */
struct input_queue {
    struct input_event events[INPUT_EVENTS_MAX];
    int first, count;
    char *path;      /* the path of the event that was taken last */
    long lost_count; /* events that found no room */
};

void input_queue_finish(struct input_queue *queue); /* frees paths; zeros it */

/* Appends an event; its path is copied. If many events wait and the last is a pointer move,
 * a new move replaces it. Only the newest INPUT_SIZE and the newest INPUT_CLOSE wait, and
 * these are never refused. A full queue refuses and counts moves, keys down, text and so on.
 * Room is reserved for events that end something (button and key up, leave, focus lost).
 * False: the event was refused. */
bool input_queue_put(struct input_queue *queue, const struct input_event *event);

/* Takes the first waiting event. False if there is none; *event is then NONE. */
bool input_queue_take(struct input_queue *queue, struct input_event *event);

/* Seconds of a monotonic clock. */
double input_now_s(void);

#endif

/* osc_stage.c - see osc_stage.h. */
#include "osc_stage.h"

#include "osc.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PACKETS_OF_A_TURN = 500, ADDRESS_BYTES = 64 }; /* more wait for the next picture */

struct osc_stage {
    struct osc_stage_def def;
    struct osc_port *port;
    const struct control *rows;
    int rows_count;
    double *sent; /* by row; NaN: nothing yet */
};

enum stage_status osc_stage_open(const struct osc_stage_def *def, struct osc_stage **out)
{
    struct osc_stage *o = calloc(1, sizeof *o);
    *out = NULL;
    if (!o)
        return stage_fail(STAGE_NO_MEMORY, "no memory for OSC");
    o->def = *def;
    o->rows = stage_controls(def->stage, &o->rows_count);
    o->sent = malloc((size_t)o->rows_count * sizeof *o->sent);
    enum stage_status status = o->sent ? osc_port_open(&def->port, &o->port)
                                       : stage_fail(STAGE_NO_MEMORY, "no memory for OSC");
    for (int i = 0; i < o->rows_count && status == STAGE_OK; i++)
        o->sent[i] = NAN;
    if (status == STAGE_OK)
        *out = o;
    else
        osc_stage_close(o);
    return status;
}

void osc_stage_close(struct osc_stage *o)
{
    if (!o)
        return;
    osc_port_close(o->port);
    free(o->sent);
    free(o);
}

int osc_stage_port(const struct osc_stage *o)
{
    return osc_port_number(o->port);
}

static void tell(struct osc_stage *o, const char *address, const char *why)
{
    char line[400];
    snprintf(line, sizeof line, "OSC: %.80s: %.300s", address, why);
    if (o->def.tell)
        o->def.tell(o->def.context, line);
}

/* ---- what is heard ---- */

static size_t value_write(const struct osc_stage *o, int row, uint8_t *out, size_t room)
{
    char address[ADDRESS_BYTES];
    snprintf(address, sizeof address, "/control/%.50s", o->rows[row].name);
    return osc_message_write(out, room, address, "f",
                             control_read(&o->rows[row], o->def.stage));
}

/* A number, T or F, or words as the command line has them. */
static enum stage_status value_of(const struct control *row, const struct osc_argument *a,
                                  double *value)
{
    if (a->text)
        return stage_control_parse(row, a->text, value);
    *value = a->number;
    return isfinite(*value) ? STAGE_OK
                            : stage_fail(STAGE_BAD_ARGUMENT, "%s must be a number", row->name);
}

static void control_set(struct osc_stage *o, int row, const struct osc_message *m, bool along)
{
    const struct control *control = &o->rows[row];
    uint8_t out[OSC_PACKET_MAX];
    double value;
    if (m->count == 0) {
        osc_port_answer(o->port, out, value_write(o, row, out, sizeof out));
        return;
    }
    enum stage_status status = value_of(control, &m->arguments[0], &value);
    if (status == STAGE_OK)
        status = stage_control_write(control, o->def.stage,
                                     along ? control_at(control, value) : value);
    if (status != STAGE_OK)
        tell(o, m->address, stage_error());
    else
        o->sent[row] = control_read(control, o->def.stage);
}

/* Whether it is of controls; then it has been done. */
static bool controls_take(struct osc_stage *o, const struct osc_message *m, const char *prefix,
                          bool along)
{
    int found = 0;
    const size_t length = strlen(prefix);
    if (strncmp(m->address, prefix, length) != 0)
        return false;
    for (int i = 0; i < o->rows_count; i++)
        if (osc_address_matches(m->address + length, o->rows[i].name)) {
            control_set(o, i, m, along);
            found++;
        }
    if (!found) {
        stage_control_find(o->rows, o->rows_count, m->address + length);
        tell(o, m->address, stage_error());
    }
    return true;
}

static const char *undo(void *context, int number)
{
    const struct osc_stage *o = context;
    (void)number;
    return stage_undo(o->def.stage) ? NULL : "there is nothing to undo";
}

static const char *reset(void *context, int number)
{
    const struct osc_stage *o = context;
    (void)number;
    return stage_reset(o->def.stage) == STAGE_OK ? NULL : stage_error();
}

/* What has a number. Not there: *why says so. */
static bool number_take(struct osc_stage *o, const struct osc_message *m, const char **why)
{
    const struct {
        const char *address;
        const char *(*run)(void *context, int number);
        void *context;
        bool has_number;
    } rows[] = {{"/scene", o->def.scene, o->def.context, true},
                {"/knobs", o->def.knobs, o->def.context, true},
                {"/go", o->def.go, o->def.context, false},
                {"/undo", undo, o, false},
                {"/reset", reset, o, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (strcmp(m->address, rows[i].address) != 0)
            continue;
        const double number = m->count && !m->arguments[0].text ? m->arguments[0].number : NAN;
        if (!rows[i].run)
            *why = "there are none: --knobs FILE has them";
        else if (rows[i].has_number && !(number >= 1 && number <= 128))
            *why = "goes with a number, 1 to 128";
        else
            *why = rows[i].run(rows[i].context, rows[i].has_number ? (int)number : 0);
        return true;
    }
    return false;
}

static void message_take(void *context, const struct osc_message *m)
{
    struct osc_stage *o = context;
    const char *why = NULL;
    if (controls_take(o, m, "/control/", false) || controls_take(o, m, "/along/", true))
        return;
    if (strcmp(m->address, "/text") == 0) {
        if (!o->def.text)
            why = "this stage has no text";
        else if (m->count != 1 || !m->arguments[0].text)
            why = "goes with one string";
        else
            why = o->def.text(o->def.context, m->arguments[0].text);
    } else if (!number_take(o, m, &why) && !(o->def.other && o->def.other(o->def.context, m))) {
        why = "there are /control/NAME, /along/NAME, /text, /scene, /knobs, /go, /undo, /reset";
    }
    if (why)
        tell(o, m->address, why);
}

void osc_stage_take(struct osc_stage *o)
{
    uint8_t bytes[OSC_PACKET_MAX];
    for (int i = 0; i < PACKETS_OF_A_TURN; i++) {
        const size_t count = osc_port_next(o->port, bytes, sizeof bytes);
        if (!count)
            return;
        const char *why = osc_packet_read(bytes, count, message_take, o);
        if (why)
            tell(o, "a packet was dropped", why);
    }
}

/* ---- what is told ---- */

void osc_stage_tell(struct osc_stage *o)
{
    uint8_t out[OSC_PACKET_MAX];
    for (int i = 0; i < o->rows_count; i++) {
        const double value = control_read(&o->rows[i], o->def.stage);
        if (value == o->sent[i])
            continue;
        o->sent[i] = value;
        osc_port_send(o->port, out, value_write(o, i, out, sizeof out));
    }
}

void osc_stage_send(struct osc_stage *o, const uint8_t *bytes, size_t count)
{
    osc_port_send(o->port, bytes, count);
}

void osc_stage_sound(struct osc_stage *o, const struct stage_sound *sound)
{
    uint8_t out[OSC_PACKET_MAX];
    char address[ADDRESS_BYTES];
    snprintf(address, sizeof address, "/sound/%.50s", sound->name);
    osc_port_send(o->port, out,
                  osc_message_write(out, sizeof out, address, "fff", sound->strength, sound->x,
                                    sound->y));
}

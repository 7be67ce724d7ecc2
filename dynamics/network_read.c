/* network_read.c - see network_file.h and reader.h. */
#include "network_file.h"
#include "reader.h"

#include <stdlib.h>
#include <string.h>

/* Reads name=value. *seen: a bit for each field that the line has had. */
static enum dyn_status field_read(struct dyn_reader *r, const struct control *fields,
                                  const struct control *(*find)(const char *), char *word,
                                  void *of, unsigned *seen)
{
    double value = 0;
    char *equals = strchr(word, '=');
    if (!equals)
        return dyn_reader_fail(r, "'%.40s' is no name=value", word);
    *equals = '\0';
    const struct control *field = find(word);
    if (!field)
        return dyn_reader_wrong(r, DYN_BAD_ARGUMENT);
    if (*seen >> (field - fields) & 1)
        return dyn_reader_fail(r, "%s twice", field->name);
    *seen |= 1u << (field - fields);
    enum dyn_status status = dyn_reader_number(r, field->name, equals + 1, &value);
    if (status == DYN_OK && dyn_control_write(field, of, value) != DYN_OK)
        status = dyn_reader_wrong(r, DYN_BAD_ARGUMENT);
    return status;
}

static enum dyn_status time_read(struct dyn_reader *r, void *network)
{
    double time = 0;
    enum dyn_status status = dyn_reader_number(r, "time", dyn_reader_word(r), &time);
    if (status != DYN_OK)
        return status;
    if (!(time >= -DYN_TIME_MAX && time <= DYN_TIME_MAX))
        return dyn_reader_fail(r, "time_s must be %g..%g (got %g)", -DYN_TIME_MAX, DYN_TIME_MAX,
                               time);
    dyn_network_time_set(network, time);
    return DYN_OK;
}

static enum dyn_status control_line_read(struct dyn_reader *r, void *network)
{
    const char *name = dyn_reader_word(r), *text = dyn_reader_word(r);
    struct dyn_world world = *dyn_network_world(network);
    double value = 0;
    if (!name || !text)
        return dyn_reader_fail(r, "a control has a name and a value");
    const struct control *control = dyn_control_find(name);
    if (!control || dyn_control_parse(control, text, &value) != DYN_OK ||
        dyn_control_write(control, &world, value) != DYN_OK ||
        dyn_network_world_set(network, &world) != DYN_OK)
        return dyn_reader_wrong(r, DYN_BAD_ARGUMENT);
    return DYN_OK;
}

static enum dyn_status mass_read(struct dyn_reader *r, void *network)
{
    struct dyn_mass mass = dyn_mass_usual();
    unsigned seen = 0;
    for (char *word; (word = dyn_reader_word(r));) {
        enum dyn_status status = DYN_OK;
        if (strcmp(word, "stuck") == 0)
            mass.hold |= DYN_STUCK;
        else if (strcmp(word, "held") == 0)
            mass.hold |= DYN_HELD;
        else
            status = field_read(r, dyn_mass_fields, dyn_mass_field_find, word, &mass, &seen);
        if (status != DYN_OK)
            return status;
    }
    enum dyn_status status = dyn_mass_add(network, &mass, NULL);
    return status == DYN_OK ? DYN_OK : dyn_reader_wrong(r, status);
}

static enum dyn_status spring_read(struct dyn_reader *r, void *network)
{
    struct dyn_spring spring = dyn_spring_usual();
    unsigned seen = 0;
    enum dyn_status status = DYN_OK;
    for (int i = 0; i < 2 && status == DYN_OK; i++)
        status = dyn_reader_mass(r, i ? "second end" : "first end", dyn_reader_word(r),
                                 &spring.end[i]);
    for (char *word; status == DYN_OK && (word = dyn_reader_word(r));)
        if (strcmp(word, "broken") == 0)
            spring.broken = true;
        else
            status =
                field_read(r, dyn_spring_fields, dyn_spring_field_find, word, &spring, &seen);
    if (status != DYN_OK)
        return status;
    status = dyn_spring_add(network, &spring, NULL);
    return status == DYN_OK ? DYN_OK : dyn_reader_wrong(r, status);
}

static enum dyn_status pull_read(struct dyn_reader *r, void *network)
{
    static const char *const names[] = {"x", "y", "constant", "damping"};
    double values[4] = {0};
    int mass = 0;
    enum dyn_status status = dyn_reader_mass(r, "mass", dyn_reader_word(r), &mass);
    for (int i = 0; i < 4 && status == DYN_OK; i++)
        status = dyn_reader_number(r, names[i], dyn_reader_word(r), &values[i]);
    if (status != DYN_OK)
        return status;
    if (dyn_control_check(dyn_spring_field_find("damping"), values[3]) != DYN_OK)
        return dyn_reader_wrong(r, DYN_BAD_ARGUMENT);
    status = dyn_pull_begin(network, mass, values[0], values[1], values[2]);
    if (status != DYN_OK)
        return dyn_reader_wrong(r, status);
    dyn_pull_of(network, mass)->damping = values[3];
    return DYN_OK;
}

enum dyn_status dyn_network_parse(const char *text, size_t bytes, const char *name,
                                  struct dyn_network **out)
{
    static const struct dyn_reader_line lines[] = {{"time_s", time_read},
                                                   {"control", control_line_read},
                                                   {"mass", mass_read},
                                                   {"spring", spring_read},
                                                   {"pull", pull_read}};
    struct dyn_reader r = {.name = name};
    enum dyn_status status = dyn_network_create(out);
    if (status == DYN_OK)
        status = dyn_reader_run(&r, text, bytes, "springs 1", lines,
                                sizeof lines / sizeof *lines, *out);
    if (status != DYN_OK) {
        dyn_network_destroy(*out);
        *out = NULL;
    }
    return status;
}

enum dyn_status dyn_network_read(const char *path, struct dyn_network **out)
{
    char *text;
    size_t bytes = 0;
    *out = NULL;
    enum dyn_status status = dyn_file_bytes(path, &text, &bytes);
    if (status == DYN_OK)
        status = dyn_network_parse(text, bytes, path, out);
    free(text);
    return status;
}

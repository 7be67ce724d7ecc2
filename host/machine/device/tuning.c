/* tuning.c - the file with a device's knobs, which `lutetia tune` writes.
 *
 * Each device has a text file tuning-HASH in the folder of disk_cache.c, with all of these
 * lines in this order. A file with another version number is ignored.
 *
 *     lutetia tuning 2
 *     platform Portable Computing Language
 *     device pthread-AMD EPYC
 *     driver 3.1
 *     vector 16
 *     run 4096
 *     ...                    each knob
 *     op_fs 64000            what one costs, in femtoseconds; 0: not measured
 *     ...                    each cost
 *     end
 *
 * The hash is of the platform's and the device's name only. So a file made with another
 * driver is found, and reported as too old. A malformed file is ignored.
 */
#include "device/tuning.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/parts.h"
#include "device/disk_cache.h"
#include "output_file.h"

#define FIRST_LINE "lutetia tuning 2"

/* Costs are written in whole femtoseconds. */
#define FS_IN_NS 1e6
#define COST_FS_MOST UINT64_C(1000000000000000) /* a second */

static const char *const names[MACHINE_KNOBS] = {
    [MACHINE_VECTOR] = "vector",   [MACHINE_RUN] = "run",
    [MACHINE_STREAMS] = "streams", [MACHINE_TURNS] = "turns",
    [MACHINE_COLUMNS] = "columns", [MACHINE_STRIPS_EACH] = "strips_each"};

static const struct {
    const char *name, *line;
} costs[MACHINE_COSTS] = {[MACHINE_COST_OP] = {"operation", "op_fs"},
                          [MACHINE_COST_BYTE] = {"byte", "byte_fs"},
                          [MACHINE_COST_NEAR_BYTE] = {"near byte", "near_byte_fs"},
                          [MACHINE_COST_LAUNCH] = {"launch", "launch_fs"}};

const char *machine_cost_name(enum machine_cost cost)
{
    return costs[cost].name;
}

bool machine_cost_allows(enum machine_cost cost, double ns)
{
    (void)cost;
    return ns >= 1 / FS_IN_NS && ns <= (double)COST_FS_MOST / FS_IN_NS;
}

const char *machine_knob_name(enum machine_knob knob)
{
    return names[knob];
}

struct machine_tuning machine_tuning_usual(void)
{
    struct machine_tuning usual;
    for (int k = 0; k < MACHINE_KNOBS; k++)
        usual.of[k] = -1;
    for (int i = 0; i < MACHINE_COSTS; i++)
        usual.cost_ns[i] = 0;
    return usual;
}

struct machine_tuning machine_tuning_get(const struct machine *m)
{
    const struct device_shape *shape = &m->device->shape;
    struct machine_tuning tuning = {.of = {[MACHINE_VECTOR] = shape->vector,
                                           [MACHINE_RUN] = shape->run_columns,
                                           [MACHINE_STREAMS] = shape->streams,
                                           [MACHINE_TURNS] = shape->turns,
                                           [MACHINE_COLUMNS] = shape->strip_columns,
                                           [MACHINE_STRIPS_EACH] = shape->strips_each}};
    for (int i = 0; i < MACHINE_COSTS; i++)
        tuning.cost_ns[i] = shape_cost_ns(shape, (enum machine_cost)i);
    return tuning;
}

/* ---- the text ---- */

struct reader {
    const char *at, *end;
    int line;
    char *why;
    size_t why_size;
};

__attribute__((format(printf, 2, 3))) static bool wrong(struct reader *r, const char *format,
                                                        ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = snprintf(r->why, r->why_size, "line %d: ", r->line);
    if (n > 0 && (size_t)n < r->why_size)
        vsnprintf(r->why + n, r->why_size - (size_t)n, format, arguments);
    va_end(arguments);
    return false;
}

/* Reads the next line, without its end. False: there is none, or it is too long, or not
 * text. */
static bool line_read(struct reader *r, char *out, size_t size)
{
    const char *end = memchr(r->at, '\n', (size_t)(r->end - r->at));
    r->line++;
    if (!end)
        return wrong(r, "the file ends too early");
    size_t length = (size_t)(end - r->at);
    if (length >= size)
        return wrong(r, "it is too long");
    for (size_t i = 0; i < length; i++) {
        if ((unsigned char)r->at[i] < ' ')
            return wrong(r, "it is no text");
        out[i] = r->at[i];
    }
    out[length] = 0;
    r->at = end + 1;
    return true;
}

/* Reads a line `name text`; *out is the text. */
static bool named_read(struct reader *r, const char *name, char *line, size_t size,
                       const char **out)
{
    size_t length = strlen(name);
    if (!line_read(r, line, size))
        return false;
    if (strncmp(line, name, length) != 0 || line[length] != ' ')
        return wrong(r, "must be %s (is \"%.40s\")", name, line);
    *out = line + length + 1;
    return true;
}

static bool same_read(struct reader *r, const char *name, const char *wanted, bool of_old)
{
    char line[320];
    const char *text = "";
    if (!named_read(r, name, line, sizeof line, &text))
        return false;
    if (!strcmp(text, wanted))
        return true;
    return of_old ? wrong(r, "it was made with %s %.40s, and this is %.40s", name, text, wanted)
                  : wrong(r, "it is for another %s, \"%.40s\"", name, text);
}

bool tuning_parse(const char *bytes, size_t length, const struct device *d,
                  struct machine_tuning *out, char *why, size_t why_size)
{
    struct reader r = {bytes, bytes + length, 0, why, why_size};
    struct machine_tuning found;
    char line[320];
    const char *text = "";
    *out = machine_tuning_usual();
    if (!line_read(&r, line, sizeof line))
        return false;
    if (strcmp(line, FIRST_LINE) != 0)
        return wrong(&r, "must be \"" FIRST_LINE "\"");
    if (!same_read(&r, "platform", d->platform_name, false) ||
        !same_read(&r, "device", d->name, false) || !same_read(&r, "driver", d->driver, true))
        return false;
    for (int k = 0; k < MACHINE_KNOBS; k++) {
        uint64_t value;
        if (!named_read(&r, names[k], line, sizeof line, &text))
            return false;
        if (!settings_number(text, &value) || value > INT32_MAX ||
            !machine_knob_allows((enum machine_knob)k, (int)value))
            return wrong(&r, "%s must be %s (is \"%.20s\")", names[k],
                         settings_knob_may_be((enum machine_knob)k), text);
        found.of[k] = (int)value;
    }
    for (int i = 0; i < MACHINE_COSTS; i++) {
        uint64_t fs;
        if (!named_read(&r, costs[i].line, line, sizeof line, &text))
            return false;
        if (!settings_number(text, &fs) || fs > COST_FS_MOST)
            return wrong(&r, "%s must be a number from 0 to 10^15 (is \"%.20s\")",
                         costs[i].line, text);
        found.cost_ns[i] = (double)fs / FS_IN_NS;
    }
    if (!line_read(&r, line, sizeof line))
        return false;
    if (strcmp(line, "end") != 0 || r.at != r.end)
        return wrong(&r, "must be \"end\", and the last");
    *out = found;
    return true;
}

/* ---- the file ---- */

static bool file_path(char *out, size_t size, const struct device *d)
{
    char folder[MACHINE_CACHE_FOLDER_MAX];
    if (!machine_cache_folder(folder, NULL))
        return false;
    uint64_t hash = cache_hash(cache_hash(CACHE_HASH_BEGIN, d->platform_name), d->name);
    int n = snprintf(out, size, "%s/tuning-%016llx", folder, (unsigned long long)hash);
    return n > 0 && (size_t)n < size;
}

static enum machine_tuned file_read(const struct device *d, struct machine_tuning *out,
                                    char *why, size_t why_size)
{
    char path[600], bytes[TUNING_BYTES_MOST + 1];
    *out = machine_tuning_usual();
    FILE *f = file_path(path, sizeof path, d) ? cache_file_read(path) : NULL;
    if (!f)
        return MACHINE_UNTUNED;
    size_t length = fread(bytes, 1, sizeof bytes, f);
    bool good = !ferror(f);
    fclose(f);
    if (!good)
        snprintf(why, why_size, "it cannot be read");
    else if (length > TUNING_BYTES_MOST)
        snprintf(why, why_size, "it is too long");
    else if (tuning_parse(bytes, length, d, out, why, why_size))
        return MACHINE_TUNED;
    return MACHINE_TUNED_BADLY;
}

void tuning_apply(struct machine *m, const struct machine_config *config)
{
    struct device *d = m->device;
    struct machine_tuning tuning = machine_tuning_usual();
    char why[160];
    if (config->tuning)
        tuning = *config->tuning;
    else if (m->settings.tuned) /* where it is ignored, machine_tuning_describe() says why */
        file_read(d, &tuning, why, sizeof why);
    for (int k = 0; k < MACHINE_KNOBS; k++)
        if (m->settings.knob[k] == SETTING_FREE &&
            machine_knob_allows((enum machine_knob)k, tuning.of[k]))
            m->settings.knob[k] = (uint64_t)tuning.of[k];
    for (int i = 0; i < MACHINE_COSTS; i++)
        if (machine_cost_allows((enum machine_cost)i, tuning.cost_ns[i]))
            m->settings.cost_ns[i] = tuning.cost_ns[i];
}

enum machine_tuned machine_tuning_describe(const struct machine *m, char *out, size_t size)
{
    char path[600], why[160];
    struct machine_tuning tuning;
    enum machine_tuned tuned = file_read(m->device, &tuning, why, sizeof why);
    if (!file_path(path, sizeof path, m->device))
        snprintf(out, size, "not tuned; there is no cache folder to keep a tuning in");
    else if (tuned == MACHINE_UNTUNED)
        snprintf(out, size, "not tuned; `lutetia tune` measures what suits the device");
    else if (tuned == MACHINE_TUNED)
        snprintf(out, size, "tuned by %s", path);
    else
        snprintf(out, size, "%s is ignored: %s; `lutetia tune` makes another", path, why);
    return tuned;
}

static void file_write(FILE *f, const struct device *d, const struct machine_tuning *tuning)
{
    fprintf(f, FIRST_LINE "\nplatform %s\ndevice %s\ndriver %s\n", d->platform_name, d->name,
            d->driver);
    for (int k = 0; k < MACHINE_KNOBS; k++)
        fprintf(f, "%s %d\n", names[k], tuning->of[k]);
    for (int i = 0; i < MACHINE_COSTS; i++)
        fprintf(f, "%s %.0f\n", costs[i].line, tuning->cost_ns[i] * FS_IN_NS);
    fputs("end\n", f);
}

enum machine_status machine_tuning_keep(struct machine *m, const struct machine_tuning *tuning)
{
    char folder[MACHINE_CACHE_FOLDER_MAX], path[600];
    const char *why = NULL;
    struct output_file out;
    for (int k = 0; k < MACHINE_KNOBS; k++)
        if (!machine_knob_allows((enum machine_knob)k, tuning->of[k]))
            return machine_fail(m, MACHINE_BAD_ARGUMENT, "%s must be %s (is %d)", names[k],
                                settings_knob_may_be((enum machine_knob)k), tuning->of[k]);
    for (int i = 0; i < MACHINE_COSTS; i++)
        if (tuning->cost_ns[i] < 0 ||
            (tuning->cost_ns[i] > 0 &&
             !machine_cost_allows((enum machine_cost)i, tuning->cost_ns[i])))
            return machine_fail(m, MACHINE_BAD_ARGUMENT,
                                "%s must be 0, or from 10^-6 to 10^9 ns (is %g)", costs[i].name,
                                tuning->cost_ns[i]);
    if (!machine_cache_folder(folder, &why) || why || !file_path(path, sizeof path, m->device))
        return machine_fail(
            m, MACHINE_BAD_ARGUMENT,
            "there is no folder to keep a tuning in (%s): set XDG_CACHE_HOME, or "
            "HOME, to one of your own",
            why ? why : "none can be made");
    bool done = output_file_open(&out, path);
    if (done) {
        file_write(out.stream, m->device, tuning);
        done = output_file_commit(&out);
    }
    return done ? MACHINE_OK
                : machine_fail(m, MACHINE_BAD_ARGUMENT, "%s cannot be written: %s", path,
                               out.why);
}

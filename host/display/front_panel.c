/* front_panel.c - red lights over the scene of front_panel_scene.c.
 *
 * The fixed parts are computed once: the scene, and for each light its footprint, which is the
 * pixels that it covers and how much of each. A picture is the sum of three images of one
 * number a pixel, all of them red light:
 *
 *     direct   the footprints of lights that are on                   width x height
 *     bloom    direct, made small, blurred at three widths, added     half, a quarter, an eighth
 *     mirror   mirrored lights, blurred by the floor's roughness      half
 *
 * The three are added to the scene in linear light. The sum goes through the response curve
 * of a film, and is written as sRGB with a fixed dither of one level, so that dark gradients
 * have no steps.
 */
#include "front_panel.h"
#include "display_internal.h"
#include "front_panel_scene.h"

#include <srgb.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

struct print {
    uint32_t pixel;
    float weight;
};

struct sheet {
    int width, height;
    float *at;
};

enum {
    BLOOMS = 3,
    CURVE_COUNT = 1 << 15,
    DOOR_LIGHTS_COUNT = FRONT_PANEL_LIGHTS / SCENE_GLOWS
};
#define CURVE_END 6.0f

/* Red light of 660 nm, as film records it: very bright lights turn towards orange and white. */
static const float red[3] = {1.0f, 0.030f, 0.011f};

struct front_panel {
    struct front_panel_config config;
    struct scene_camera camera;
    struct scene_pixel *scene;
    struct print *prints, *mirrored; /* footprints of all lights, one after the other */
    uint32_t print_first[FRONT_PANEL_LIGHTS + 1], mirrored_first[FRONT_PANEL_LIGHTS + 1];
    float light_x[FRONT_PANEL_LIGHTS], light_y[FRONT_PANEL_LIGHTS];
    float pitch_px; /* distance from a light to its neighbour */
    struct sheet direct, half, bloom[BLOOMS], mirror, spare;
    uint16_t curve[CURVE_COUNT]; /* sRGB values, in 256ths of a level */
};

struct front_panel_config front_panel_config_default(void)
{
    return (struct front_panel_config){
        .width_px = 960, .height_px = 960, .view = FRONT_PANEL_CUBE, .brightness = 1};
}

void front_panel_place(int light, int *column, int *row)
{
    *column = light % FRONT_PANEL_COLUMNS;
    *row = light / FRONT_PANEL_COLUMNS;
}

static bool sheet_make(struct sheet *sheet, int width, int height)
{
    *sheet =
        (struct sheet){width, height, calloc((size_t)width * (size_t)height, sizeof(float))};
    return sheet->at != NULL;
}

/* ---- footprints ---- */

struct prints_list {
    struct print *at;
    size_t count, room;
};

static bool print_add(struct prints_list *list, uint32_t pixel, float weight)
{
    if (list->count == list->room) {
        size_t room = list->room ? 2 * list->room : 1 << 16;
        struct print *grown = realloc(list->at, room * sizeof *grown);
        if (!grown)
            return false;
        list->at = grown;
        list->room = room;
    }
    list->at[list->count++] = (struct print){pixel, weight};
    return true;
}

/* An ellipse of light in an image: its centre, and the vectors in pixels of one light's
 * pitch to the right and down; profile is a function of the distance in pitches. */
struct ellipse {
    float x, y, ax, ay, bx, by, reach;
    float (*profile)(float distance, float softness);
    float softness;
};

static float profile_lamp(float distance, float softness)
{
    (void)softness;
    if (distance < 0.26f)
        return 4.6f + 4 * (0.26f - distance);
    float fall = (distance - 0.26f) / 0.085f;
    return 4.6f * expf(-fall * fall) + 0.10f * expf(-distance * distance * 6);
}

static float profile_soft(float distance, float softness)
{
    float k = distance / softness;
    return 0.17f * expf(-0.5f * k * k) / (softness * softness);
}

static bool ellipse_print(struct prints_list *list, const struct sheet *sheet, struct ellipse e,
                          int samples)
{
    float det = e.ax * e.by - e.ay * e.bx;
    if (fabsf(det) < 1e-6f)
        return true;
    float wide = e.reach * (fabsf(e.ax) + fabsf(e.bx)),
          high = e.reach * (fabsf(e.ay) + fabsf(e.by));
    int x0 = (int)floorf(fmaxf(e.x - wide, 0)), y0 = (int)floorf(fmaxf(e.y - high, 0));
    int x1 = (int)fminf(e.x + wide + 1, (float)sheet->width),
        y1 = (int)fminf(e.y + high + 1, (float)sheet->height);
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) {
            float sum = 0;
            for (int i = 0; i < samples * samples; i++) {
                float dx = (float)x + ((float)(i % samples) + 0.5f) / (float)samples - e.x;
                float dy = (float)y + ((float)(i / samples) + 0.5f) / (float)samples - e.y;
                float u = (dx * e.by - dy * e.bx) / det, v = (dy * e.ax - dx * e.ay) / det;
                sum += e.profile(sqrtf(u * u + v * v), e.softness);
            }
            sum /= (float)(samples * samples);
            if (sum > 0.002f && !print_add(list, (uint32_t)(y * sheet->width + x), sum))
                return false;
        }
    return true;
}

/* The ellipse of the light at that place. mirrored: its reflection in the floor, in an image
 * of half the size. */
static struct ellipse ellipse_of(const struct front_panel *panel, float column, float row,
                                 bool mirrored)
{
    float at[3][2], scale = mirrored ? 0.5f : 1;
    for (int i = 0; i < 3; i++) {
        struct vec p =
            scene_front_point(column + (i == 1 ? 0.25f : 0), row + (i == 2 ? 0.25f : 0));
        if (mirrored)
            p.y = 2 * SCENE_FLOOR - p.y;
        scene_project(&panel->camera, p, &at[i][0], &at[i][1]);
    }
    return (struct ellipse){.x = at[0][0] * scale,
                            .y = at[0][1] * scale,
                            .ax = (at[1][0] - at[0][0]) * 4 * scale,
                            .ay = (at[1][1] - at[0][1]) * 4 * scale,
                            .bx = (at[2][0] - at[0][0]) * 4 * scale,
                            .by = (at[2][1] - at[0][1]) * 4 * scale};
}

static bool footprints_make(struct front_panel *panel)
{
    struct prints_list list = {0}, mirrored = {0};
    bool good = true;
    for (int light = 0; light < FRONT_PANEL_LIGHTS && good; light++) {
        int column, row;
        front_panel_place(light, &column, &row);
        panel->print_first[light] = (uint32_t)list.count;
        panel->mirrored_first[light] = (uint32_t)mirrored.count;
        struct ellipse e = ellipse_of(panel, (float)column + 0.5f, (float)row + 0.5f, false);
        panel->light_x[light] = e.x;
        panel->light_y[light] = e.y;
        panel->pitch_px = sqrtf(fabsf(e.ax * e.by - e.ay * e.bx));
        e.reach = 0.85f;
        e.profile = profile_lamp;
        good = ellipse_print(&list, &panel->direct, e, panel->pitch_px > 24 ? 2 : 4);
        if (!good || panel->config.view != FRONT_PANEL_CUBE)
            continue;
        /* The floor is slightly rough: the higher a light is, the more its reflection is
         * blurred. */
        e = ellipse_of(panel, (float)column + 0.5f, (float)row + 0.5f, true);
        e.softness = 0.38f + 0.020f * (64 - (float)row);
        e.reach = 2.4f * e.softness;
        e.profile = profile_soft;
        good = ellipse_print(&mirrored, &panel->mirror, e, 1);
    }
    panel->print_first[FRONT_PANEL_LIGHTS] = (uint32_t)list.count;
    panel->mirrored_first[FRONT_PANEL_LIGHTS] = (uint32_t)mirrored.count;
    panel->prints = list.at;
    panel->mirrored = mirrored.at;
    return good;
}

/* ---- a panel ---- */

static void curve_make(struct front_panel *panel)
{
    for (int i = 0; i < CURVE_COUNT; i++) {
        /* The index is a square root, so that dark levels, where the eye is sensitive, have
         * enough entries. */
        float x = (float)i / (CURVE_COUNT - 1);
        x = x * x * CURVE_END;
        float seen = 1 - expf(-1.15f * x);
        panel->curve[i] = (uint16_t)(srgb_number(seen) * 255 * 256);
    }
}

static bool sheets_make(struct front_panel *panel)
{
    int w = panel->config.width_px, h = panel->config.height_px;
    int hw = (w + 1) / 2, hh = (h + 1) / 2;
    bool good = sheet_make(&panel->direct, w, h) && sheet_make(&panel->half, hw, hh) &&
                sheet_make(&panel->mirror, hw, hh) && sheet_make(&panel->spare, hw, hh);
    for (int i = 0; i < BLOOMS && good; i++)
        good = sheet_make(&panel->bloom[i], (w + (2 << i) - 1) / (2 << i),
                          (h + (2 << i) - 1) / (2 << i));
    return good;
}

static bool differ(const struct scene_pixel *a, const struct scene_pixel *b)
{
    float sum = a->rgb[1] + b->rgb[1];
    return fabsf(a->rgb[1] - b->rgb[1]) > 0.0006f + 0.06f * sum ||
           fabsf(a->mirror - b->mirror) > 0.02f;
}

/* One ray for each pixel, and sixteen where neighbours differ. */
static void scene_make(struct front_panel *panel)
{
    int w = panel->config.width_px, h = panel->config.height_px;
    struct scene_pixel *scene = panel->scene;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            scene[y * w + x] = scene_pixel_trace(&panel->camera, panel->config.view, x, y, 1);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const struct scene_pixel *at = scene + y * w + x;
            panel->direct.at[y * w + x] =
                (x > 0 && differ(at, at - 1)) || (x + 1 < w && differ(at, at + 1)) ||
                (y > 0 && differ(at, at - w)) || (y + 1 < h && differ(at, at + w));
        }
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            if (panel->direct.at[y * w + x] > 0)
                scene[y * w + x] =
                    scene_pixel_trace(&panel->camera, panel->config.view, x, y, 4);
}

enum display_status front_panel_create(const struct front_panel_config *config,
                                       struct front_panel **out)
{
    *out = NULL;
    if (config->width_px < FRONT_PANEL_SIDE_MIN || config->height_px < FRONT_PANEL_SIDE_MIN ||
        config->width_px > FRONT_PANEL_SIDE_MAX || config->height_px > FRONT_PANEL_SIDE_MAX ||
        !(config->brightness >= 0 && config->brightness <= 10) ||
        (unsigned)config->view > FRONT_PANEL_DOOR)
        return display_fail(
            DISPLAY_BAD_ARGUMENT,
            "a front panel is %d..%d pixels wide and high, its brightness 0..10 "
            "(got %dx%d and %g)",
            FRONT_PANEL_SIDE_MIN, FRONT_PANEL_SIDE_MAX, config->width_px, config->height_px,
            config->brightness);
    struct front_panel *panel = calloc(1, sizeof *panel);
    int w = config->width_px, h = config->height_px;
    if (panel) {
        panel->config = *config;
        panel->camera = scene_camera_make(config);
        panel->scene = malloc((size_t)w * (size_t)h * sizeof *panel->scene);
    }
    if (!panel || !panel->scene || !sheets_make(panel) || !footprints_make(panel)) {
        front_panel_destroy(panel);
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a front panel of %dx%d pixels", w,
                            h);
    }
    scene_make(panel);
    for (uint32_t i = 0; i < panel->print_first[FRONT_PANEL_LIGHTS];
         i++) /* lights that are off */
        for (int k = 0; k < 3; k++)
            panel->scene[panel->prints[i].pixel].rgb[k] +=
                panel->prints[i].weight * (k == 0 ? 0.0034f : 0.0006f);
    curve_make(panel);
    *out = panel;
    return DISPLAY_OK;
}

void front_panel_destroy(struct front_panel *panel)
{
    if (!panel)
        return;
    for (int i = 0; i < BLOOMS; i++)
        free(panel->bloom[i].at);
    free(panel->direct.at);
    free(panel->half.at);
    free(panel->mirror.at);
    free(panel->spare.at);
    free(panel->scene);
    free(panel->prints);
    free(panel->mirrored);
    free(panel);
}

int front_panel_light_at(const struct front_panel *panel, int light, int *x_px, int *y_px)
{
    if (light < 0 || light >= FRONT_PANEL_LIGHTS)
        return 0;
    *x_px = (int)floorf(panel->light_x[light]);
    *y_px = (int)floorf(panel->light_y[light]);
    return *x_px >= 0 && *y_px >= 0 && *x_px < panel->config.width_px &&
           *y_px < panel->config.height_px;
}

/* ---- blurs ---- */

/* to = the means of from's 2x2 pixels. */
static void sheet_shrink(const struct sheet *from, struct sheet *to)
{
    for (int y = 0; y < to->height; y++) {
        const float *a = from->at + (size_t)(2 * y) * (size_t)from->width;
        const float *b = 2 * y + 1 < from->height ? a + from->width : a;
        float *out = to->at + (size_t)y * (size_t)to->width;
        for (int x = 0; x < to->width; x++) {
            int right = 2 * x + 1 < from->width ? 2 * x + 1 : 2 * x;
            out[x] = 0.25f * (a[2 * x] + a[right] + b[2 * x] + b[right]);
        }
    }
}

/* to = the running mean over 2r + 1 of from's rows, columns and rows changing places, so that
 * two of them blur both ways; outside is dark. */
static void sheet_mean(const float *from, float *to, int width, int height, int r)
{
    float share = 1 / (float)(2 * r + 1);
    for (int y = 0; y < height; y++) {
        const float *row = from + (size_t)y * (size_t)width;
        float sum = 0;
        for (int x = 0; x < r && x < width; x++)
            sum += row[x];
        for (int x = 0; x < width; x++) {
            if (x + r < width)
                sum += row[x + r];
            if (x - r - 1 >= 0)
                sum -= row[x - r - 1];
            to[(size_t)x * (size_t)height + (size_t)y] = fmaxf(sum, 0) * share;
        }
    }
}

/* Three box blurs approximate a Gaussian. */
static void sheet_blur(struct sheet *sheet, float *spare, int r)
{
    for (int i = 0; i < 3 && r > 0; i++) {
        sheet_mean(sheet->at, spare, sheet->width, sheet->height, r);
        sheet_mean(spare, sheet->at, sheet->height, sheet->width, r);
    }
}

/* A row of a smaller sheet as a row of width pixels, added to out, bilinearly. */
static void sheet_row_add(const struct sheet *sheet, int shift, int y, int width, float weight,
                          float *out)
{
    float scale = 1 / (float)(1 << shift);
    float fy = fmaxf(((float)y + 0.5f) * scale - 0.5f, 0);
    int y0 = (int)fy < sheet->height - 1 ? (int)fy : sheet->height - 1;
    int y1 = y0 + 1 < sheet->height ? y0 + 1 : y0;
    float ky = fy - (float)y0;
    const float *a = sheet->at + (size_t)y0 * (size_t)sheet->width,
                *b = sheet->at + (size_t)y1 * (size_t)sheet->width;
    for (int x = 0; x < width; x++) {
        float fx = fmaxf(((float)x + 0.5f) * scale - 0.5f, 0);
        int x0 = (int)fx < sheet->width - 1 ? (int)fx : sheet->width - 1;
        int x1 = x0 + 1 < sheet->width ? x0 + 1 : x0;
        float kx = fx - (float)x0;
        float top = a[x0] + (a[x1] - a[x0]) * kx, low = b[x0] + (b[x1] - b[x0]) * kx;
        out[x] += weight * (top + (low - top) * ky);
    }
}

/* ---- a picture ---- */

static bool light_on(const uint8_t *lights, int light)
{
    return lights[light / 8] >> (light % 8) & 1;
}

static void lights_print(struct front_panel *panel, const uint8_t *lights, float *doors)
{
    memset(panel->direct.at, 0,
           (size_t)panel->direct.width * (size_t)panel->direct.height * sizeof(float));
    memset(panel->mirror.at, 0,
           (size_t)panel->mirror.width * (size_t)panel->mirror.height * sizeof(float));
    for (int light = 0; light < FRONT_PANEL_LIGHTS; light++) {
        if (!light_on(lights, light))
            continue;
        doors[light / 2048 * 2 + light / 32 % 2] += 1.0f / DOOR_LIGHTS_COUNT;
        for (uint32_t i = panel->print_first[light]; i < panel->print_first[light + 1]; i++)
            panel->direct.at[panel->prints[i].pixel] += panel->prints[i].weight;
        for (uint32_t i = panel->mirrored_first[light]; i < panel->mirrored_first[light + 1];
             i++)
            panel->mirror.at[panel->mirrored[i].pixel] += panel->mirrored[i].weight;
    }
}

/* Light scattered by lens and glass, with blur widths in proportion to the lights. */
static void blooms_make(struct front_panel *panel)
{
    sheet_shrink(&panel->direct, &panel->bloom[0]);
    for (int i = 1; i < BLOOMS; i++)
        sheet_shrink(&panel->bloom[i - 1], &panel->bloom[i]);
    static const float widths[BLOOMS] = {0.28f, 1.1f, 4.5f}; /* in pitches */
    for (int i = 0; i < BLOOMS; i++) {
        int r = (int)lroundf(widths[i] * panel->pitch_px / (float)(2 << i));
        sheet_blur(&panel->bloom[i], panel->spare.at, r > 0 ? r : 1);
    }
}

static uint8_t level(const struct front_panel *panel, float x, uint32_t dither)
{
    float k = sqrtf(fminf(x, CURVE_END) * (1 / CURVE_END)) * (CURVE_COUNT - 1);
    return (uint8_t)((panel->curve[(int)k] + dither) >> 8);
}

enum display_status front_panel_draw(struct front_panel *panel,
                                     const uint8_t lights[FRONT_PANEL_BYTES],
                                     struct display_image *image)
{
    int w = panel->config.width_px, h = panel->config.height_px;
    if (!image->pixels) {
        *image = (struct display_image){.width_px = w, .height_px = h, .channels = 3};
        enum display_status status = display_image_create(image);
        if (status != DISPLAY_OK)
            return status;
    }
    if (image->width_px != w || image->height_px != h || image->channels != 3)
        return display_fail(
            DISPLAY_BAD_ARGUMENT,
            "the panel is %dx%d pixels with 3 channels, the image %dx%d with %d", w, h,
            image->width_px, image->height_px, image->channels);
    float doors[SCENE_GLOWS] = {0}, bright = (float)panel->config.brightness;
    lights_print(panel, lights, doors);
    blooms_make(panel);
    float *row = calloc(2 * (size_t)w, sizeof(float)), *floor_row = row + w;
    if (!row)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a row of %d pixels", w);
    static const float weights[BLOOMS] = {0.30f, 0.13f, 0.085f};
    for (int y = 0; y < h; y++) {
        memset(row, 0, 2 * (size_t)w * sizeof(float));
        for (int i = 0; i < BLOOMS; i++)
            sheet_row_add(&panel->bloom[i], i + 1, y, w, weights[i], row);
        if (panel->config.view == FRONT_PANEL_CUBE)
            sheet_row_add(&panel->mirror, 1, y, w, 1, floor_row);
        for (int x = 0; x < w; x++) {
            const struct scene_pixel *s = &panel->scene[y * w + x];
            float light = panel->direct.at[y * w + x] + row[x] + s->mirror * floor_row[x];
            for (int k = 0; k < SCENE_GLOWS; k++)
                light += s->glow[k] * doors[k];
            light *= bright;
            /* The dither is a hash of the pixel's place: the same in every picture, so that
             * a film does not flicker. */
            uint32_t hash = ((uint32_t)x * 0x9e3779b1u) ^ ((uint32_t)y * 0x85ebca77u);
            hash ^= hash >> 15;
            hash *= 0x2c1b3c6du;
            uint8_t *out = image->pixels + 3 * ((size_t)y * (size_t)w + (size_t)x);
            for (int k = 0; k < 3; k++)
                out[k] = level(panel, s->rgb[k] + red[k] * light, hash >> 24);
        }
    }
    free(row);
    return DISPLAY_OK;
}

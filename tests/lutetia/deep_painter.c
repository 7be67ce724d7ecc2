/* deep_painter.c - a C/Paris program that writes a picture of 40x30 to a display of 24 bits in
 * several ways, of which the last is seen. At (x, y) it has 6x red, 8y green and 5x + y blue.
 *
 *     deep_painter whole|raw|channels|parts|turned */
#include <cm/cmfb.h>

#include <string.h>

enum { WIDTH = 40, HEIGHT = 30 };

static CM_field_id_t pixel, parts[3];

static void picture_make(unsigned int x_axis)
{
    CM_field_id_t x = CM_allocate_heap_field(8), y = CM_allocate_heap_field(8);
    pixel = CM_allocate_heap_field(24);
    for (int i = 0; i < 3; i++)
        parts[i] = CM_add_offset_to_field_id(pixel, 8 * i);
    CM_my_news_coordinate_1L(x, x_axis, 8);
    CM_my_news_coordinate_1L(y, 1 - x_axis, 8);
    CM_u_multiply_constant_3_1L(parts[0], x, 6, 8);
    CM_u_multiply_constant_3_1L(parts[1], y, 8, 8);
    CM_u_multiply_constant_3_1L(parts[2], x, 5, 8);
    CM_u_add_2_1L(parts[2], y, 8);
}

int main(int argc, char **argv)
{
    const char *how = argc > 1 ? argv[1] : "whole";
    const int turned = strcmp(how, "turned") == 0;
    unsigned int sizes[2] = {turned ? WIDTH : HEIGHT, turned ? HEIGHT : WIDTH};
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    picture_make(turned ? 0 : 1);
    CMFB_display_id_t display = CMFB_attach_display("deep");
    CMFB_initialize_display(display, 24, WIDTH, HEIGHT);
    if (turned)
        CMFB_set_axes(display, 0, 1);
    if (strcmp(how, "raw") == 0) {
        CM_field_id_t shuffled = CM_allocate_heap_field(24);
        CMFB_shuffle_from_news_always(display, shuffled, pixel, 24);
        CMFB_write_always(display, 0, shuffled, 0, 0);
    } else if (strcmp(how, "channels") == 0 || turned) {
        CMFB_write_rgb_news_always(display, 0, parts[0], parts[1], parts[2], 0, 0);
    } else if (strcmp(how, "parts") == 0) {
        /* the picture's last column and row first, then what lies over most of it */
        CMFB_clear(display, 0, 0xffffff);
        CMFB_write_rgb_news_always(display, 0, parts[0], parts[1], parts[2], 0, 0);
        CMFB_write_news_always(display, 0, pixel, -7, -11);
        CMFB_write_news_always(display, 0, pixel, 0, 0);
        CMFB_write_rgb_news_always(display, 0, parts[0], parts[1], parts[2], 39, 29);
        CMFB_write_rgb_news_always(display, 0, parts[0], parts[1], parts[2], 0, 0);
        CMFB_write_news_always(display, 0, pixel, 0, 30);
    } else {
        CMFB_write_news_always(display, 0, pixel, 0, 0);
    }
    return 0;
}

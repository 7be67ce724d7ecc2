/* lanes_products.h - a product within a sum: a part of fast_loops.h, whose macros it uses. Both
 * are rounded. Of a factor that is the same in all lanes only the first may be there. */

#define PRODUCT_SUM(F, PRODUCT)                                                                \
    {                                                                                          \
        if (s->detail == 0)                                                                    \
            EACH d[i] = c[i] + (PRODUCT);                                                      \
        else if (s->detail == 1)                                                               \
            EACH d[i] = c[i] - (PRODUCT);                                                      \
        else if (s->detail == 2)                                                               \
            EACH d[i] = (PRODUCT) + c[i];                                                      \
        else                                                                                   \
            EACH d[i] = (PRODUCT)-c[i];                                                        \
    }

#define PRODUCT_SUMS(F)                                                                        \
    LOOP(product_sum, F)                                                                       \
    {                                                                                          \
        TO(F);                                                                                 \
        IN(F, 0, a);                                                                           \
        IN(F, 1, b);                                                                           \
        IN(F, 2, c);                                                                           \
        const F x = a[0], y = b[0];                                                            \
        if (s->axis == 1)                                                                      \
            PRODUCT_SUM(F, x *b[i])                                                            \
        else if (s->axis == 2)                                                                 \
            PRODUCT_SUM(F, a[i] * y)                                                           \
        else if (s->axis == 3)                                                                 \
            PRODUCT_SUM(F, x *y)                                                               \
        else                                                                                   \
            PRODUCT_SUM(F, a[i] * b[i])                                                        \
    }
PRODUCT_SUMS(f32)
PRODUCT_SUMS(f64)

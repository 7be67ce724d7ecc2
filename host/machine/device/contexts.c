/* contexts.c - OpenCL's contexts: one that a machine leaves is kept for the next machine of
 * this process. PoCL reads its library of built-in functions, 9 MB of LLVM's code, for each
 * context in which it compiles. Reading takes as long as some ten kernels do. */
#include <pthread.h>

#include "device/device.h"

static struct {
    pthread_mutex_t lock;
    cl_device_id device;
    cl_context context; /* NULL: none is kept */
} kept = {.lock = PTHREAD_MUTEX_INITIALIZER};

static cl_context kept_take(cl_device_id device)
{
    pthread_mutex_lock(&kept.lock);
    cl_context context = kept.device == device ? kept.context : NULL;
    if (context)
        kept.context = NULL;
    pthread_mutex_unlock(&kept.lock);
    return context;
}

cl_context device_context(const struct device *d, const cl_device_id *ids, cl_uint count,
                          cl_int *error)
{
    cl_context context = count == 1 && device_is_ours(d) ? kept_take(ids[0]) : NULL;
    *error = CL_SUCCESS;
    return context ? context : clCreateContext(NULL, count, ids, NULL, NULL, error);
}

/* Whether the context is of one device, and of no shares of it. */
static bool is_of_one(cl_context context)
{
    cl_uint count = 0;
    return clGetContextInfo(context, CL_CONTEXT_NUM_DEVICES, sizeof count, &count, NULL) ==
               CL_SUCCESS &&
           count == 1;
}

void device_context_leave(const struct device *d)
{
    cl_context context = d->context;
    if (is_of_one(context)) {
        pthread_mutex_lock(&kept.lock);
        if (!kept.context) {
            kept.context = context;
            kept.device = d->id;
            context = NULL;
        }
        pthread_mutex_unlock(&kept.lock);
    }
    if (context)
        clReleaseContext(context);
}

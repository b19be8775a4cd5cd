#define PNEUMA_ROW_KERNELS rowKernelsPortable
#define PNEUMA_ROW_KERNELS_NAME "portable"
#include "growth/row_kernels_body.h"

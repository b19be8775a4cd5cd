#define PNEUMA_ROW_KERNELS rowKernelsAvx2
#define PNEUMA_ROW_KERNELS_NAME "avx2"
#include "growth/row_kernels_body.h"

#define PNEUMA_ROW_KERNELS rowKernelsAvx512
#define PNEUMA_ROW_KERNELS_NAME "avx512"
#include "growth/row_kernels_body.h"

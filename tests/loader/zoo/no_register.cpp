#include <muster/plugin.h>
MUSTER_DECLARE_ABI

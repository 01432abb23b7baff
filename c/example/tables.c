/* The tables, defined once. */
#define I7000_DEFINE_TABLES
#include "../i7000.h"

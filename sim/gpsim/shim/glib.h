// SPDX-License-Identifier: MIT
// The only names of glib that gpsim 0.31's headers use, so that gpsim-dev alone
// is enough to build against them.
#ifndef GLIB_H
#define GLIB_H
#include <stdint.h>

typedef int8_t gint8;
typedef uint8_t guint8;
typedef int32_t gint32;
typedef uint32_t guint32;
typedef int64_t gint64;
typedef uint64_t guint64;
typedef int gint;
typedef int gboolean;
typedef void *gpointer;
typedef struct _GSList GSList;

#endif

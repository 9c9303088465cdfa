// SPDX-License-Identifier: MIT
#include "fixpid_table.h"

#define READ *
#include "fixpid_table_text.h"

/* See base/windows/everywhere.h. */
#pragma once

#include_next <dirent.h>

int dirfd(DIR *folder);

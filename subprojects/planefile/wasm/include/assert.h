/* For modules: what is examined while they are built. */
#pragma once
#define static_assert _Static_assert

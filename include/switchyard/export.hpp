// switchyard/export.hpp - which names leave libswitchyard; all others are hidden.
#pragma once

#define SWITCHYARD_EXPORT __attribute__((visibility("default")))

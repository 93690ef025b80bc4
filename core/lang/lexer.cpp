#include "core/lang/lexer.h"

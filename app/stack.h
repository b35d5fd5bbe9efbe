#pragma once

namespace sateen::app {

/// Sees to it that the process and its threads have the stack that a picture takes, where `ulimit -s` allows less:
/// raises the soft limit as far as is of use. OperationError where the hard one is too small, for a stack that ends
/// would end the program without a word.
void provide_stack();

}  // namespace sateen::app

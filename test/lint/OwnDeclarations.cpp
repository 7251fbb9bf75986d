/// Lets clang-tidy look only at what we wrote. Its checks walk through every
/// declaration of a unit, and nine tenths of them are the system's.
#include <clang/AST/ASTConsumer.h>
#include <clang/AST/ASTContext.h>
#include <clang/Frontend/FrontendPluginRegistry.h>

namespace {

class Scope : public clang::ASTConsumer {
  void HandleTranslationUnit(clang::ASTContext &Context) override {
    std::vector<clang::Decl *> Own;
    for (clang::Decl *D : Context.getTranslationUnitDecl()->decls())
      if (!Context.getSourceManager().isInSystemHeader(D->getLocation()))
        Own.push_back(D);
    Context.setTraversalScope(Own);
  }
};

class Action : public clang::PluginASTAction {
  std::unique_ptr<clang::ASTConsumer>
  CreateASTConsumer(clang::CompilerInstance &, llvm::StringRef) override {
    return std::make_unique<Scope>();
  }
  bool ParseArgs(const clang::CompilerInstance &,
                 const std::vector<std::string> &) override {
    return true;
  }
  ActionType getActionType() override { return AddBeforeMainAction; }
};

const clang::FrontendPluginRegistry::Add<Action>
    Registered("own-declarations", "looks at no declaration of the system");

} // namespace

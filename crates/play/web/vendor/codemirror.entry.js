// What the editor uses of CodeMirror; build.mjs bundles it as the global CodeMirror.
export { EditorState, Compartment } from '@codemirror/state';
export {
  EditorView, keymap, lineNumbers, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, drawSelection,
} from '@codemirror/view';
export { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
export { StreamLanguage, HighlightStyle, syntaxHighlighting, bracketMatching } from '@codemirror/language';
export { search, searchKeymap, highlightSelectionMatches, openSearchPanel } from '@codemirror/search';
export { lintGutter, setDiagnostics } from '@codemirror/lint';
export { toml } from '@codemirror/legacy-modes/mode/toml';
export { tags } from '@lezer/highlight';

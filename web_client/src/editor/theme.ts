/** Colours and fonts of the editor. CSS variables of the page are inherited into the shadow root. */
import { HighlightStyle, syntaxHighlighting } from '@codemirror/language';
import { EditorView } from '@codemirror/view';
import { Tag } from '@lezer/highlight';

/** One highlighting tag for each kind of token. */
export const tags = {
  module: Tag.define(), turtle: Tag.define(), branch: Tag.define(), arrow: Tag.define(), paren: Tag.define(), number: Tag.define(),
  function: Tag.define(), word: Tag.define(), operator: Tag.define(), string: Tag.define(), member: Tag.define(), comment: Tag.define(),
};

export const colours = syntaxHighlighting(HighlightStyle.define([
  { tag: tags.module, color: 'var(--code-module)', fontWeight: '600' },
  { tag: tags.turtle, color: 'var(--code-turtle)' },
  { tag: tags.branch, color: 'var(--code-branch)', fontWeight: '700' },
  { tag: tags.arrow, color: 'var(--code-arrow)', fontWeight: '700' },
  { tag: tags.number, color: 'var(--code-number)' },
  { tag: tags.function, color: 'var(--code-function)' },
  { tag: tags.string, color: 'var(--code-number)' },
  { tag: tags.member, color: 'var(--code-module)' },
  { tag: tags.comment, color: 'var(--soft)', fontStyle: 'italic' },
]));

const box = { backgroundColor: 'var(--panel)', color: 'var(--ink)', border: '1px solid var(--line-strong)', borderRadius: '8px', boxShadow: 'var(--shadow)' };

export const look = EditorView.theme({
  '&': { backgroundColor: 'var(--sunk)', color: 'var(--ink)', border: '1px solid var(--line-strong)', borderRadius: '8px', fontSize: '13px', maxHeight: 'var(--code-height, 340px)' },
  '&.cm-focused': { outline: '2px solid var(--accent)', outlineOffset: '1px' },
  '.cm-scroller': { fontFamily: 'var(--mono)', lineHeight: '20px', overflow: 'auto', borderRadius: '7px', scrollbarWidth: 'thin' },
  '.cm-content': { padding: '8px 0', caretColor: 'var(--ink)', minHeight: '36px' },
  '.cm-content[aria-invalid=true]': { boxShadow: 'inset 3px 0 0 var(--error)' },
  '.cm-gutters': { backgroundColor: 'var(--panel)', color: 'var(--soft)', borderRight: '1px solid var(--line)' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'transparent' },
  '.cm-content ::selection': { backgroundColor: 'var(--code-selection)' },
  '&.cm-focused .cm-matchingBracket': { backgroundColor: 'var(--accent-pale)', outline: '1px solid var(--accent)' },
  '.cm-lintRange-error': { backgroundImage: 'none', textDecoration: 'underline wavy var(--error) 1.5px', textUnderlineOffset: '3px', backgroundColor: 'color-mix(in srgb, var(--error) 16%, transparent)' },
  '.cm-lintRange-warning': { backgroundImage: 'none', textDecoration: 'underline wavy var(--mild) 1.5px', textUnderlineOffset: '3px' },
  '.cm-lintPoint::after': { borderBottomColor: 'var(--error)' },
  '.cm-tooltip': box,
  '.cm-diagnostic': { padding: '5px 9px', fontFamily: 'system-ui, sans-serif', borderLeft: '4px solid var(--error)' },
  '.cm-diagnostic-warning': { borderLeftColor: 'var(--mild)' },
  '.cm-tooltip-autocomplete > ul': { fontFamily: 'var(--mono)', maxHeight: '220px' },
  '.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--accent-ink)' },
  '.cm-completionDetail': { color: 'inherit', fontStyle: 'normal', marginLeft: '10px' },
  '.cm-completionInfo': { ...box, padding: '7px 10px', maxWidth: '280px', fontFamily: 'system-ui, sans-serif' },
});

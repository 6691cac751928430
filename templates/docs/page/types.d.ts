/* What the data of a page has: `readDevice` makes it of the JSON that generator/fieldscribe/targets/docs/html.py writes. */

/** A title alone, or in the languages of the device, English first. */
type Title = string | string[];
/** The position of a fact among all facts, its label, its text. */
type FactRow = [number, string, string];
/** Number, name, title, and a quantity. */
type Entry = [any, string, Title?, string?];
/** Lowest bit, width, name, title, the state in which it is true, what its numbers mean. */
type Flag = [number, number, string, Title, number, Entry[]];
/** A place in a manual: number of the document, section, page, line. */
type ManualPlace = [number?, string?, string?, number?];
/** A generated point: each device has its own. */
type Codec = any;

/** What points of one kind share; what is empty is left out. */
interface Kind {
  rows: FactRow[];
  access: string;
  space: string;
  width: number;
  telegram?: string;
  type?: string;
  form?: string;
  unit?: string;
  unitName?: string;
  low?: number;
  isGroup?: boolean;
  signal?: number[];
  generated?: boolean;
  counts: number;
  needs?: string[];
  links?: string[];
  base?: string;
  fixed?: number[];
  enum?: number;
  digits?: number;
  word?: number;
  codes?: number;
}

interface Point {
  name: string;
  kind: number;
  limits: number;
  code: string;
  title: Title;
  group: number;
  addresses: number[];
  numbers: number[];
  printed: number;
  rows: FactRow[];
  source: ManualPlace;
  errata: number[];
  note: Title;
  variant: string;
  index: number | string;
  written: number[];
  default: string;
  was: string[];
  identifiers: string[];
  place: number;
  shared: Kind;
  allowed: { range?: string; raw?: string; needs?: string };
  [field: string]: any;
}

interface Erratum {
  id: string;
  points: string[];
  where: string;
  printed: string;
  taken: string;
  why: string;
  certainty: string;
  /** The facts that the manual leaves open, each with what is open. */
  open: [fact: string, text: string][];
  source: ManualPlace;
}

interface PageDevice {
  id: string;
  /** The page that lists several devices; missing where there is none. */
  index?: string;
  name: string;
  title: Title;
  note: Title;
  version: string;
  made: string;
  family: string;
  framings: string[];
  languages: string[];
  variants: Record<string, string[]>;
  documents: string[];
  groups: [string, Title, Title?][];
  telegrams: [string, Title, string, number][];
  messages: [string, Title, string, string, string[]][];
  errata: Erratum[];
  sections: Record<string, [string, string][]>;
  bus: { gaps: Record<string, [number, number][]>; [codes: string]: any };
  frames: string[][];
  /** Name, space, address, value, title, in the order of the package; those of several steps have no space. */
  commands: [string, string, number, number | null, Title][];
  fields: string[];
  points: Point[];
  numberings: string[];
  kinds: Kind[];
  limits: Point["allowed"][];
  enums: { name: string; closed: boolean; entries: Entry[] }[];
  words: Flag[][];
  codes: [string, string, Title, string][][];
  names: Record<string, string>;
  byName: Map<string, Point>;
}

declare var openCode: (() => any) | undefined;

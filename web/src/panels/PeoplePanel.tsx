/** Say who may use the robot: add a person or a telephone by a link shown once, remove one. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { encode } from "uqr";
import { t } from "../i18n";
import { addPerson, listPeople, removePerson } from "../net/api";
import { attempt } from "../state/acts";
import { tell } from "../state/note";
import type { NewPerson, Person, PersonRole } from "../wire/types";

const ROLES: readonly PersonRole[] = ["operator", "viewer", "dispatcher", "agent"];
const people = signal<readonly Person[] | null>(null); // null: not ours to see
const name = signal("");
const role = signal<PersonRole>("operator");
const made = signal<NewPerson | null>(null);
const doubted = signal<string | null>(null); // whose removal is being asked about

async function look(): Promise<void> {
  people.value = await listPeople().catch(() => null);
}

async function add(): Promise<void> {
  const kept = await attempt(async () => {
    made.value = await addPerson(name.value.trim(), role.value);
    return undefined;
  });
  if (kept) name.value = "";
  await look();
}

async function remove(person: Person): Promise<void> {
  doubted.value = null;
  await attempt(async () => {
    await removePerson(person.id);
    tell(t("people.removed", { name: person.name }));
    return undefined;
  });
  if (made.value?.id === person.id) made.value = null;
  await look();
}

export function PeoplePanel() {
  useEffect(() => {
    void look();
    return () => (made.value = null); // a token isn't left on a screen
  }, []);
  if (people.value === null) return null;
  return (
    <section class="card" aria-labelledby="people-title" id="people">
      <h2 id="people-title">{t("people.title")}</h2>
      <p class="fine">{t("people.about")}</p>
      <ul class="taught">
        {people.value.map((person) => (
          <Line key={person.id} person={person} />
        ))}
      </ul>
      <form
        class="memory-form"
        onSubmit={(event) => {
          event.preventDefault();
          void add();
        }}
      >
        <label for="person-name">{t("people.name")}</label>
        <input
          id="person-name"
          maxLength={64}
          value={name.value}
          onInput={(event) => (name.value = event.currentTarget.value)}
        />
        <select
          aria-label={t("people.role")}
          value={role.value}
          onChange={(event) => (role.value = event.currentTarget.value as PersonRole)}
        >
          {ROLES.map((each) => (
            <option key={each} value={each}>
              {t(`people.${each}`)}
            </option>
          ))}
        </select>
        <button type="submit" disabled={name.value.trim() === ""}>
          {t("people.add")}
        </button>
      </form>
      {made.value && <Pairing person={made.value} />}
    </section>
  );
}

function Line({ person }: { readonly person: Person }) {
  return (
    <li data-person={person.id}>
      <span class="said">
        <strong dir="auto">{person.name}</strong>
        <span class="fine">{t(`people.${person.role}`)}</span>
      </span>
      <span class="buttons">
        {doubted.value === person.id ? (
          <>
            <button type="button" class="main" onClick={() => void remove(person)}>
              {t("people.remove_yes")}
            </button>
            <button type="button" class="quiet" onClick={() => (doubted.value = null)}>
              {t("op.no")}
            </button>
          </>
        ) : (
          <button
            type="button"
            aria-label={`${t("people.remove")}: ${person.name}`}
            onClick={() => (doubted.value = person.id)}
          >
            {t("people.remove")}
          </button>
        )}
      </span>
    </li>
  );
}

/** Show the link that makes a telephone this person's, as text and as a QR code. */
function Pairing({ person }: { readonly person: NewPerson }) {
  const link = `${location.origin}${location.pathname}#token=${person.token}`;
  return (
    <div class="pairing" role="status">
      <p>{t("people.scan", { name: person.name })}</p>
      <QrCode text={link} label={t("people.qr", { name: person.name })} />
      <p class="fine">
        <code id="pairing-link">{link}</code>
      </p>
      {["127.0.0.1", "localhost"].includes(location.hostname) && (
        <p class="fine">{t("people.loopback")}</p>
      )}
      <button type="button" onClick={() => (made.value = null)}>
        {t("people.done")}
      </button>
    </div>
  );
}

function QrCode({ text, label }: { readonly text: string; readonly label: string }) {
  const { size, data } = encode(text, { border: 2 });
  const cells = data.flatMap((row, y) =>
    row.flatMap((dark, x) => (dark ? `M${x} ${y}h1v1h-1z` : [])),
  );
  return (
    <svg class="qr" viewBox={`0 0 ${size} ${size}`} role="img" aria-label={label}>
      <path d={cells.join("")} />
    </svg>
  );
}
